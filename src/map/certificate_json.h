// Certificates as part of a map's JSON (docs/map_format.md).
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "map/certificate.h"

namespace redmap {

nlohmann::ordered_json describe(const Certificate& certificate);
/// Throws Error, beginning with `where`, on anything missing or out of range.
Certificate parse_certificate(const nlohmann::ordered_json& json, const std::string& where);

}  // namespace redmap
