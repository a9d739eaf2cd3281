#include "map/certificate.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "map/certificate_json.h"
#include "map/json_reader.h"

namespace redmap {

namespace {

constexpr double kAnything = std::numeric_limits<float>::max();
/// Rows that a file may have: far more than octaves from a texel to a planet.
constexpr std::size_t kMostRows = 64;

float error_in(const JsonReader& reader, const char* key) {
  return static_cast<float>(reader.number(key, 0, kAnything));
}

Certificate::Row parse_row(const JsonReader& reader) {
  Certificate::Row row;
  row.minification = error_in(reader, "minification");
  row.pixels = static_cast<int>(reader.number("pixels", 0, 1e9));
  row.rms_error = error_in(reader, "rms_error"), row.mean_error = error_in(reader, "mean_error");
  row.bound = error_in(reader, "bound");
  const std::vector<float> bounds = reader.numbers("bound_by_half_angle", kHalfAngleKinds, kHalfAngleKinds);
  std::copy(bounds.begin(), bounds.end(), row.bound_of_kind.begin());
  return row;
}

Certificate::Place parse_place(const JsonReader& reader) {
  const std::vector<float> uv = reader.numbers("uv", 2, 2);
  return {reader.vector("position"), {uv[0], uv[1]}, error_in(reader, "minification"), error_in(reader, "error")};
}

}  // namespace

float largest_bound(const Certificate& certificate) {
  float largest = 0;
  for (const Certificate::Row& row : certificate.rows) largest = std::max(largest, row.bound);
  return largest;
}

std::optional<float> bound_of(const Certificate& certificate, float minification, float half_degrees) {
  constexpr float kHalfOctave = 0.51f;  // rows are an octave wide, and roundings
  for (const Certificate::Row& row : certificate.rows)
    if (std::abs(std::log2(minification / row.minification)) <= kHalfOctave)
      return row.bound_of_kind[half_angle_kind(half_degrees)];
  return std::nullopt;
}

nlohmann::ordered_json describe(const Certificate& certificate) {
  Json rows = Json::array();
  for (const Certificate::Row& row : certificate.rows)
    rows.push_back({{"minification", row.minification},
                    {"pixels", row.pixels},
                    {"rms_error", row.rms_error},
                    {"mean_error", row.mean_error},
                    {"bound", row.bound},
                    {"bound_by_half_angle", row.bound_of_kind}});
  const Certificate::Place& worst = certificate.worst;
  return {{"coverage", certificate.coverage},
          {"quality", certificate.quality},
          {"samples", certificate.samples},
          {"residual", certificate.residual},
          {"rows", rows},
          {"worst",
           {{"position", {worst.position.x, worst.position.y, worst.position.z}},
            {"uv", {worst.uv.x, worst.uv.y}},
            {"minification", worst.minification},
            {"error", worst.error}}},
          {"weakest", certificate.weakest},
          {"reason", certificate.reason}};
}

Certificate parse_certificate(const nlohmann::ordered_json& json, const std::string& where) {
  const JsonReader reader(json, where);
  Certificate certificate;
  certificate.coverage = static_cast<float>(reader.number("coverage", 0, 1));
  certificate.quality = reader.text("quality");
  certificate.samples = static_cast<int>(reader.number("samples", 0, 1e9));
  certificate.residual = error_in(reader, "residual");
  const Json& rows = reader.get("rows", "a list of rows");
  if (!rows.is_array() || rows.size() > kMostRows) reader.refuse("rows", fmt::format("up to {} rows", kMostRows));
  for (const Json& row : rows)
    certificate.rows.push_back(parse_row(JsonReader(row, fmt::format("{}: rows {}", where, certificate.rows.size()))));
  const Json& worst = reader.get("worst", "a place");
  certificate.worst = parse_place(JsonReader(worst, where + ": worst"));
  certificate.weakest = reader.text("weakest");
  certificate.reason = reader.text("reason");
  return certificate;
}

}  // namespace redmap
