// The name somebody probably meant, for error messages.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace redmap {

/// The candidate with the smallest edit distance (Levenshtein 1966) to `name`, the first of several; empty if there are
/// no candidates.
std::string nearest(std::string_view name, std::span<const std::string> candidates);

}  // namespace redmap
