// The extension module redmap._core, which the package redmap is (docs/python.md).
#include "base/error.h"
#include "base/parallel.h"
#include "bindings.h"

namespace redmap::python {
namespace {

void bind_threads(nb::module_& module) {
  nb::class_<ThreadLimit>(module, "ThreadLimit",
                          "As a context: while it lasts, at most `threads` threads are used (0: one per core).")
      .def(nb::init<std::size_t>(), "threads"_a)
      .def(
          "__enter__", [](nb::object self) { return self; }, nb::sig("def __enter__(self) -> ThreadLimit"))
      .def(
          "__exit__", [](nb::handle, nb::args) {}, nb::sig("def __exit__(self, *args: object) -> None"));
  module.def("thread_count", &thread_count, doc::thread_count);
}

}  // namespace
}  // namespace redmap::python

NB_MODULE(_core, module) {
  using namespace redmap::python;
  // What a program still holds when it ends is no leak of ours.
  nanobind::set_leak_warnings(false);
  nanobind::exception<redmap::Error>(module, "Error", PyExc_RuntimeError).doc() = nanobind::str(
      "A bad file, option, scene or shader: one line that says what was wrong, where, what was "
      "expected and what was found.");
  bind_threads(module);
  bind_images(module);
  bind_surfaces(module);
  bind_shaders(module);
  bind_maps(module);
  bind_baking(module);
  bind_scenes(module);
  bind_rendering(module);
  bind_verifying(module);
}
