// The machine a figure was measured on.
#pragma once

#include <nlohmann/json.hpp>

namespace redmap::cli {

/// {"processor", "cores", "threads", "memory_bytes", "compiler"}
nlohmann::json machine_json();

}  // namespace redmap::cli
