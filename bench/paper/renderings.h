// A report for people on a terminal, for scripts, and as one page for a browser that asks no network for anything.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

#include "report.h"

namespace redmap::bench {

/// Where and when a report was made: words for people, in order.
using Origin = std::vector<std::pair<std::string, std::string>>;

/// Title, claims and tables. Tables with many columns are turned on their side.
std::string text_of(const Figure& figure);

/// Everything but the pictures. Rows are objects by the keys of their columns; what is not finite is null.
nlohmann::json json_of(const Report& report);

/// A whole page, style, script and pictures included.
std::string html_of(const Report& report, const Origin& origin);

}  // namespace redmap::bench
