// The style and the script of the page, from page.css and page.js.
#pragma once

#include <string_view>

namespace redmap::bench {

extern const std::string_view kPageStyle, kPageScript;

}  // namespace redmap::bench
