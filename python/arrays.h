// NumPy arrays of what redmap stores, and the other way round. Results share redmap's memory and keep it alive; what
// goes in is copied once where redmap has a layout of its own.
#pragma once

#include <cmath>
#include <memory>
#include <string_view>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/image.h"
#include "base/surface_points.h"
#include "bindings.h"

namespace redmap::python {

/// What goes in: N rows of C numbers, of any strides.
template <std::ptrdiff_t C>
using RowsIn = nb::ndarray<const float, nb::shape<-1, C>, nb::device::cpu>;
using IndicesIn = nb::ndarray<const std::uint32_t, nb::shape<-1>, nb::device::cpu>;
using TrianglesIn = nb::ndarray<const std::uint32_t, nb::shape<-1, 3>, nb::device::cpu>;
using ImageIn = nb::ndarray<const float, nb::ndim<3>, nb::device::cpu>;

/// What comes out.
template <int C>
using RowsOut = nb::ndarray<nb::numpy, float, nb::shape<-1, C>>;
template <int C>
using RowsView = nb::ndarray<nb::numpy, const float, nb::shape<-1, C>>;
using ImageOut = nb::ndarray<nb::numpy, float, nb::ndim<3>>;

/// A Python object that keeps `value` for as long as arrays point into it.
template <typename T>
std::pair<T*, nb::capsule> keep(T&& value) {
  auto kept = std::make_unique<T>(std::move(value));
  nb::capsule owner(kept.get(), [](void* p) noexcept { delete static_cast<T*>(p); });
  return {kept.release(), owner};
}

/// `planes` as an array of shape (N, C): each column is one of them.
template <int C>
RowsView<C> view_of(std::shared_ptr<const Planes<C>> planes) {
  const auto [kept, owner] = keep(std::move(planes));
  const Planes<C>& data = **kept;
  return RowsView<C>(data[0], {data.size(), C}, owner, {1, static_cast<std::int64_t>(data.stride())});
}

template <int C>
RowsOut<C> array_of(Planes<C>&& planes) {
  const auto [kept, owner] = keep(std::move(planes));
  return RowsOut<C>((*kept)[0], {kept->size(), C}, owner, {1, static_cast<std::int64_t>(kept->stride())});
}

/// Shape (height, width, channels).
inline ImageOut array_of(Image&& image) {
  const auto [kept, owner] = keep(std::move(image));
  const auto size = [](int n) { return static_cast<std::size_t>(n); };
  return ImageOut(kept->data.data(), {size(kept->height), size(kept->width), size(kept->channels)}, owner);
}

Image image_of(const ImageIn& array);

/// Throws Error unless `found` rows are as many as `expected`.
inline void require_rows(std::string_view name, std::size_t found, std::size_t expected) {
  if (found != expected) throw Error("{}: expected {} rows as in the first array, found {}", name, expected, found);
}

/// `Vector` is C floats. Throws Error unless there are as many as `expected`, all of them finite.
template <typename Vector, std::ptrdiff_t C>
std::vector<Vector> vectors_of(std::string_view name, const RowsIn<C>& array, std::size_t expected) {
  require_rows(name, array.shape(0), expected);
  const auto view = array.view();
  std::vector<Vector> vectors(array.shape(0));
  for (std::size_t i = 0; i < vectors.size(); ++i) {
    if constexpr (C == 3)
      vectors[i] = {view(i, 0), view(i, 1), view(i, 2)};
    else
      vectors[i] = {view(i, 0), view(i, 1)};
    if (!std::isfinite(length(vectors[i])))
      throw Error("{}: expected finite numbers, found another in row {}", name, i);
  }
  return vectors;
}

}  // namespace redmap::python
