// What the files of the Python module share. Each binds what one or two folders of src offer, under the same names;
// the module's docstrings are those folders' comments (docstrings.py).
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/map.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>
#include <nanobind/stl/vector.h>

#include "docstrings.h"
#include "scene/scene.h"
#include "vector_casters.h"

namespace redmap::python {

namespace nb = nanobind;
using namespace nb::literals;

/// A Scene whose lists are Python's own, so that what they hold changes in place.
struct PythonScene {
  Camera camera;
  nb::typed<nb::list, Light> lights;
  nb::typed<nb::list, Object> objects;
  Rgb background;
  float time_seconds = 0;
};
/// Throws TypeError on anything in the lists that is no light or object.
Scene scene_of(const PythonScene& scene);

void bind_images(nb::module_& module);
void bind_surfaces(nb::module_& module);
void bind_shaders(nb::module_& module);
void bind_maps(nb::module_& module);
void bind_baking(nb::module_& module);
void bind_scenes(nb::module_& module);
void bind_rendering(nb::module_& module);
void bind_verifying(nb::module_& module);

}  // namespace redmap::python
