#include <nlohmann/json.hpp>

#include "renderings.h"

namespace redmap::bench {

namespace {

nlohmann::json json_of(const Value& value) {
  if (const auto* words = std::get_if<std::string>(&value)) return *words;
  if (const auto* number = std::get_if<double>(&value)) return *number;
  return nullptr;
}

nlohmann::json json_of(const Table& table) {
  nlohmann::json columns = nlohmann::json::array(), rows = nlohmann::json::array();
  for (const Column& column : table.columns) columns.push_back({{"key", column.key}, {"title", column.title}});
  for (const auto& row : table.rows) {
    nlohmann::json entry = nlohmann::json::object();
    for (std::size_t i = 0; i < row.size(); ++i) entry[table.columns[i].key] = json_of(row[i]);
    rows.push_back(std::move(entry));
  }
  return {{"key", table.key}, {"title", table.title}, {"columns", columns}, {"rows", rows}};
}

nlohmann::json json_of(const Plot& plot) {
  nlohmann::json series = nlohmann::json::array();
  for (const Series& one : plot.series) {
    nlohmann::json points = nlohmann::json::array();
    for (const Series::Point& point : one.points) points.push_back({point.x, point.y});
    series.push_back({{"name", one.name}, {"points", points}});
  }
  return {{"key", plot.key}, {"title", plot.title}, {"x", plot.x_title}, {"y", plot.y_title}, {"series", series}};
}

nlohmann::json json_of(const Figure& figure) {
  nlohmann::json json{{"id", figure.id},
                      {"title", figure.title},
                      {"paper", figure.paper},
                      {"ours", figure.ours},
                      {"notes", figure.notes},
                      {"tables", nlohmann::json::array()},
                      {"claims", nlohmann::json::array()},
                      {"plots", nlohmann::json::array()}};
  for (const Table& table : figure.tables) json["tables"].push_back(json_of(table));
  for (const Plot& plot : figure.plots) json["plots"].push_back(json_of(plot));
  for (const Claim& claim : figure.claims)
    json["claims"].push_back({{"asked", claim.asked}, {"found", claim.found}, {"reached", claim.reached}});
  return json;
}

}  // namespace

nlohmann::json json_of(const Report& report) {
  nlohmann::json json{{"quick", report.quick},
                      {"map_size", report.map_size},
                      {"seconds", report.seconds},
                      {"figures", nlohmann::json::array()}};
  for (const Figure& figure : report.figures) json["figures"].push_back(json_of(figure));
  return json;
}

}  // namespace redmap::bench
