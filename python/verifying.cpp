// Maps that know their own error.
#include "verify/verify.h"

#include "interruptible.h"

namespace redmap::python {
namespace {

VerifyReport verify_map(const Object& object, const std::shared_ptr<const ReductionMap>& map, int pixels, int spp,
                        const std::vector<float>& minifications, double coverage, std::uint64_t seed,
                        const Progress& progress) {
  VerifyOptions options;
  options.pixels = pixels, options.spp = spp, options.minifications = minifications;
  options.coverage = coverage, options.seed = seed;
  VerifyReport report;
  run_interruptibly(
      [&](Work& work) {
        options.progress = [&](double part) { work.tell(part); };
        options.cancelled = [&] { return work.stopped(); };
        report = verify(object, map, options);
      },
      progress);
  return report;
}

void bind_rows(nb::module_& module) {
  nb::class_<ErrorRow>(module, "ErrorRow", doc::ErrorRow)
      .def_ro("of", &ErrorRow::of, doc::ErrorRow_of)
      .def_ro("pixels", &ErrorRow::pixels)
      .def_ro("rms", &ErrorRow::rms)
      .def_ro("mean", &ErrorRow::mean)
      .def_ro("residual", &ErrorRow::residual)
      .def_ro("flip", &ErrorRow::flip)
      .def_ro("bound", &ErrorRow::bound, doc::ErrorRow_bound)
      .def_ro("flip_bound", &ErrorRow::flip_bound, doc::ErrorRow_bound);
}

}  // namespace

void bind_verifying(nb::module_& module) {
  bind_rows(module);
  nb::class_<VerifyReport>(module, "VerifyReport")
      .def_ro("all", &VerifyReport::all)
      .def_ro("by_minification", &VerifyReport::by_minification)
      .def_ro("by_level", &VerifyReport::by_level)
      .def_ro("certificate", &VerifyReport::certificate);
  const VerifyOptions options;
  module.def("verify", &verify_map, "object"_a, "map"_a, nb::kw_only(), "pixels"_a = options.pixels,
             "spp"_a = options.spp, "minifications"_a = std::vector<float>{}, "coverage"_a = options.coverage,
             "seed"_a = options.seed, "progress"_a = nb::none(), doc::verify);
}

}  // namespace redmap::python
