// Certificates for people and for scripts.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "map/certificate.h"

namespace redmap::cli {

/// Indented lines: errors and bounds by minification, the worst place, the weakest stage.
std::string certificate_text(const Certificate& certificate);
/// As it stands in the map's file.
nlohmann::json certificate_json(const Certificate& certificate);

}  // namespace redmap::cli
