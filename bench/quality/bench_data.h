// Everything that the methods of a bench need of one shader on one surface.
#pragma once

#include <functional>

#include "bake/bake.h"
#include "render/renderer.h"

namespace redmap::bench {

/// Whether one averaged material can stand in for the shader at all.
bool has_parameters(const ShaderInfo& shader);

/// The map, and the pyramids of the baselines that the shader has. Throws Error if it was cancelled.
ObjectData make_bench_data(const Surface& surface, const Shader& shader, int map_size,
                           const std::function<bool()>& cancelled, BakeReport* report = nullptr);

}  // namespace redmap::bench
