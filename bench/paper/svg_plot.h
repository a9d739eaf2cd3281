// Curves as an SVG element: both axes logarithmic, colours from the page's style.
#pragma once

#include <string>

#include "report.h"

namespace redmap::bench {

/// A <figure> with the drawing and a legend. Points that are not finite and above 0 are left out.
std::string svg_of(const Plot& plot);

/// `text` with the five characters that HTML reserves replaced.
std::string escaped(const std::string& text);

}  // namespace redmap::bench
