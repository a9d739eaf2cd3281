// A Python function as a shader: a black box that is asked in batches.
#pragma once

#include <memory>
#include <string>

#include "bindings.h"
#include "shader/shader.h"

namespace redmap::python {

/// Places that a function is asked about: arrays of N rows that share redmap's memory, and may be kept.
struct Places {
  std::shared_ptr<const SurfacePoints> points;
};

/// `function(places, to_light, to_viewer)` returns the radiance, N rows of three. Called from any thread, one at a
/// time, with the interpreter's lock. What it raises comes out of the bake or the frame that asked.
std::shared_ptr<const Shader> make_python_shader(nb::callable function, const std::string& name);

}  // namespace redmap::python
