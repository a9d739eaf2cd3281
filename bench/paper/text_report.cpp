#include <fmt/format.h>

#include <algorithm>

#include "renderings.h"

namespace redmap::bench {

namespace {

/// More columns than a terminal has room for, and rows that it has room for as columns.
constexpr std::size_t kMostColumns = 8, kMostTurnedRows = 10;

using Lines = std::vector<std::vector<std::string>>;

Lines lines_of(const Table& table) {
  Lines lines(1);
  for (const Column& column : table.columns) lines[0].push_back(column.title);
  for (const auto& row : table.rows) {
    lines.emplace_back();
    for (const Value& value : row) lines.back().push_back(text_of(value));
  }
  if (table.columns.size() <= kMostColumns || table.rows.size() > kMostTurnedRows) return lines;
  Lines turned(table.columns.size());
  for (const auto& line : lines)
    for (std::size_t column = 0; column < line.size(); ++column) turned[column].push_back(line[column]);
  return turned;
}

}  // namespace

std::string text_of(const Figure& figure) {
  std::string text = figure.title + "\n";
  for (const Table& table : figure.tables) {
    text += "  " + table.title + "\n";
    const Lines lines = lines_of(table);
    std::vector<std::size_t> widths(lines.front().size());
    for (const auto& line : lines)
      for (std::size_t i = 0; i < line.size(); ++i) widths[i] = std::max(widths[i], line[i].size());
    for (const auto& line : lines) {
      text += "   ";
      for (std::size_t i = 0; i < line.size(); ++i)
        text += i == 0 ? fmt::format(" {:<{}}", line[i], widths[i]) : fmt::format("  {:>{}}", line[i], widths[i]);
      text += "\n";
    }
  }
  for (const Claim& claim : figure.claims)
    text += fmt::format("  {}: {}: {}\n", claim.reached ? "reached" : "NOT REACHED", claim.asked, claim.found);
  for (const std::string& note : figure.notes) text += "  " + note + "\n";
  return text;
}

}  // namespace redmap::bench
