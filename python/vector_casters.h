// Small vectors and colours are tuples of floats in Python; anything with as many numbers goes in.
#pragma once

#include <nanobind/nanobind.h>

#include "base/vec.h"

namespace nanobind::detail {

/// `Vector` is `Size` floats, one after the other.
template <typename Vector, std::size_t Size>
struct float_tuple_caster {
  static_assert(sizeof(Vector) == Size * sizeof(float));

  bool from_python(handle source, std::uint32_t, cleanup_list*) noexcept {
    float* components = reinterpret_cast<float*>(&value);
    if (!PySequence_Check(source.ptr()) || PySequence_Size(source.ptr()) != static_cast<Py_ssize_t>(Size)) {
      PyErr_Clear();
      return false;
    }
    for (std::size_t i = 0; i < Size; ++i) {
      PyObject* item = PySequence_GetItem(source.ptr(), static_cast<Py_ssize_t>(i));
      const double number = item ? PyFloat_AsDouble(item) : -1.0;
      Py_XDECREF(item);
      if (PyErr_Occurred()) {
        PyErr_Clear();
        return false;
      }
      components[i] = static_cast<float>(number);
    }
    return true;
  }

  static handle from_cpp(const Vector& vector, rv_policy, cleanup_list*) noexcept {
    const float* components = reinterpret_cast<const float*>(&vector);
    PyObject* tuple = PyTuple_New(Size);
    for (std::size_t i = 0; tuple && i < Size; ++i)
      PyTuple_SetItem(tuple, static_cast<Py_ssize_t>(i), PyFloat_FromDouble(components[i]));
    return tuple;
  }

  NB_TYPE_CASTER(Vector,
                 const_name<Size == 2>(io_name("collections.abc.Sequence[float]", "tuple[float, float]"),
                                       io_name("collections.abc.Sequence[float]", "tuple[float, float, float]")))
};

template <>
struct type_caster<redmap::Vec2> : float_tuple_caster<redmap::Vec2, 2> {};
template <>
struct type_caster<redmap::Vec3> : float_tuple_caster<redmap::Vec3, 3> {};
template <>
struct type_caster<redmap::Rgb> : float_tuple_caster<redmap::Rgb, 3> {};

}  // namespace nanobind::detail
