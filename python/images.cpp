// Pictures: files, and how far they are from a reference.
#include "base/image.h"

#include "arrays.h"
#include "metrics/compare.h"

namespace redmap::python {

Image image_of(const ImageIn& array) {
  const auto view = array.view();
  Image image(static_cast<int>(array.shape(1)), static_cast<int>(array.shape(0)), static_cast<int>(array.shape(2)));
  std::size_t i = 0;
  for (std::size_t y = 0; y < array.shape(0); ++y)
    for (std::size_t x = 0; x < array.shape(1); ++x)
      for (std::size_t c = 0; c < array.shape(2); ++c) image.data[i++] = view(y, x, c);
  return image;
}

namespace {

Comparison compare(const ImageIn& image, const ImageIn& reference, const std::optional<ImageIn>& mask, int worst_pixels,
                   bool flip) {
  const Image first = image_of(image), second = image_of(reference);
  const std::optional<Image> counted = mask ? std::optional(image_of(*mask)) : std::nullopt;
  const nb::gil_scoped_release release;
  return compare_images(first, second, {counted ? &*counted : nullptr, worst_pixels, flip});
}

void bind_comparison(nb::module_& module) {
  nb::class_<PixelDifference>(module, "PixelDifference")
      .def_ro("x", &PixelDifference::x)
      .def_ro("y", &PixelDifference::y)
      .def_ro("image", &PixelDifference::image)
      .def_ro("reference", &PixelDifference::reference)
      .def_ro("error", &PixelDifference::error, doc::PixelDifference_error);
  nb::class_<Comparison>(module, "Comparison", doc::Comparison)
      .def_ro("pixels", &Comparison::pixels, doc::Comparison_pixels)
      .def_ro("rmse", &Comparison::rmse, doc::Comparison_rmse)
      .def_ro("rmse_clamped", &Comparison::rmse_clamped, doc::Comparison_rmse_clamped)
      .def_ro("psnr", &Comparison::psnr, doc::Comparison_psnr)
      .def_ro("relative_mse", &Comparison::relative_mse, doc::Comparison_relative_mse)
      .def_ro("bias", &Comparison::bias, doc::Comparison_bias)
      .def_ro("mean_error", &Comparison::mean_error, doc::Comparison_mean_error)
      .def_ro("max_error", &Comparison::max_error, doc::Comparison_max_error)
      .def_ro("flip", &Comparison::flip, doc::Comparison_flip)
      .def_ro("worst", &Comparison::worst, doc::Comparison_worst);
}

}  // namespace

void bind_images(nb::module_& module) {
  module.def(
      "read_image", [](const std::filesystem::path& path) { return array_of(read_image(path)); }, "path"_a,
      doc::read_image);
  module.def(
      "write_image",
      [](const std::filesystem::path& path, const ImageIn& image) { write_image(image_of(image), path); }, "path"_a,
      "image"_a, doc::write_image);
  bind_comparison(module);
  module.def("compare", &compare, "image"_a, "reference"_a, "mask"_a = nb::none(),
             "worst_pixels"_a = CompareOptions{}.worst_pixels, "flip"_a = true, doc::compare_images);
}

}  // namespace redmap::python
