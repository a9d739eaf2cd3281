// Maps to be exported, and folders to export them to.
#pragma once

#include "bake/bake.h"
#include "base/atomic_file.h"
#include "base/temporary_folder.h"
#include "export/export.h"

namespace redmap {

/// Of a library shader on a unit sphere.
inline ExportInput small_input(const std::string& shader, int size = 32) {
  ExportInput input;
  input.name = shader;
  input.shader = make_library_shader(shader);
  input.surface = make_sphere(1);
  BakeOptions options;
  options.size = size;
  input.map = std::make_shared<const ReductionMap>(bake(*input.surface, *input.shader, options));
  input.fits = fit_basis(*input.map, *input.shader);
  return input;
}

}  // namespace redmap
