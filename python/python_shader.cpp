#include "python_shader.h"

#include "arrays.h"
#include "base/hash.h"

namespace redmap::python {
namespace {

/// Python's objects die with its lock held, whoever lets go of them.
using SharedFunction = std::shared_ptr<const nb::callable>;

SharedFunction share(nb::callable function) {
  return {new nb::callable(std::move(function)), [](const nb::callable* f) {
            const nb::gil_scoped_acquire acquire;
            delete f;
          }};
}

/// Of what the function does, so that a map knows which version it was baked from; of its name alone where it is a
/// callable without code. Marshal's version 2 knows no references, whose bytes would depend on who else holds them.
std::uint64_t hash_of(const nb::callable& function, const std::string& name) {
  std::uint64_t hash = hash_bytes(0, name.data(), name.size());
  if (!nb::hasattr(function, "__code__")) return hash;
  const nb::object code = function.attr("__code__");
  const auto bytes = nb::cast<nb::bytes>(nb::module_::import_("marshal").attr("dumps")(code, 2));
  return hash_bytes(hash, bytes.c_str(), bytes.size());
}

/// A pair for each place, in object space.
struct ObjectPairs {
  std::shared_ptr<Planes<3>> to_light, to_viewer;
  explicit ObjectPairs(std::size_t size)
      : to_light(std::make_shared<Planes<3>>(size)), to_viewer(std::make_shared<Planes<3>>(size)) {}
};

class PythonPatterns final : public BoundPatterns {
 public:
  PythonPatterns(SharedFunction function, std::string name, const SurfacePoints& points)
      : function_(std::move(function)), name_(std::move(name)), points_(std::make_shared<SurfacePoints>(points)) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vec3 normal = points.normal.get(i), tangent = points.tangent.get(i);
      frames_.push_back({tangent, cross(normal, tangent), normal});
    }
  }

  std::size_t size() const override { return points_->size(); }

  void radiance_each(const DirectionPairs& pairs, Planes<3>& out) const override {
    ObjectPairs turned(size());
    for (std::size_t i = 0; i < size(); ++i) turn(frames_[i], pairs, i, turned, i);
    out.resize(size());
    ask(points_, turned, {out[0], out[1], out[2]});
  }

  void radiance_one(std::size_t pattern, const DirectionPairs& pairs, Planes<3>& out) const override {
    ObjectPairs turned(pairs.size());
    for (std::size_t i = 0; i < pairs.size(); ++i) turn(frames_[pattern], pairs, i, turned, i);
    out.resize(pairs.size());
    ask(repeated(*points_, pattern, pairs.size()), turned, {out[0], out[1], out[2]});
  }

  void radiance_all(const DirectionPairs& pairs, LaneVector<float>& out) const override {
    const std::size_t stride = padded(size());
    out.resize(pairs.size() * 3 * stride);
    for (std::size_t p = 0; p < pairs.size(); ++p) {
      ObjectPairs turned(size());
      for (std::size_t i = 0; i < size(); ++i) turn(frames_[i], pairs, p, turned, i);
      float* first = out.data() + p * 3 * stride;
      ask(points_, turned, {first, first + stride, first + 2 * stride});
    }
  }

  void transmittance(Planes<3>& out) const override { out = Planes<3>(size()); }
  void emission(Planes<3>& out) const override { out = Planes<3>(size()); }
  bool materials(Materials&) const override { return false; }

 private:
  static void turn(const Frame& frame, const DirectionPairs& pairs, std::size_t pair, ObjectPairs& out, std::size_t i) {
    out.to_light->set(i, frame.to_world(pairs.to_light.get(pair)));
    out.to_viewer->set(i, frame.to_world(pairs.to_viewer.get(pair)));
  }

  static std::shared_ptr<SurfacePoints> repeated(const SurfacePoints& points, std::size_t place, std::size_t count) {
    auto copies = std::make_shared<SurfacePoints>();
    copies->resize(count);
    copies->time = points.time;
    for (std::size_t i = 0; i < count; ++i) {
      copies->position.set(i, points.position.get(place)), copies->normal.set(i, points.normal.get(place));
      copies->tangent.set(i, points.tangent.get(place));
      copies->uv.set(i, Vec2{points.uv[0][place], points.uv[1][place]});
    }
    return copies;
  }

  /// Asks the function and copies what it says to three rows.
  void ask(std::shared_ptr<const SurfacePoints> points, const ObjectPairs& pairs, std::array<float*, 3> out) const {
    const nb::gil_scoped_acquire acquire;
    const std::size_t count = points->size();
    const nb::object answer = (*function_)(Places{points}, view_of<3>(pairs.to_light), view_of<3>(pairs.to_viewer));
    RowsIn<3> rows;
    if (!nb::try_cast(answer, rows) || rows.shape(0) != count)
      throw Error("shader \"{}\": expected an array of shape ({}, 3), found {}", name_, count, shape_of(answer));
    const auto view = rows.view();
    for (std::size_t i = 0; i < count; ++i)
      for (int c = 0; c < 3; ++c) {
        out[c][i] = view(i, c);
        if (!std::isfinite(view(i, c)))
          throw Error("shader \"{}\": expected finite numbers, found {} at position ({:g}, {:g}, {:g})", name_,
                      view(i, c), points->position[0][i], points->position[1][i], points->position[2][i]);
      }
  }

  static std::string shape_of(const nb::object& answer) {
    const nb::object what = nb::hasattr(answer, "shape") ? answer.attr("shape") : answer.type().attr("__name__");
    return nb::str(what).c_str();
  }

  SharedFunction function_;
  std::string name_;
  std::shared_ptr<const SurfacePoints> points_;
  std::vector<Frame> frames_;
};

class PythonShader final : public Shader {
 public:
  PythonShader(nb::callable function, const std::string& name) {
    info_.name = name;
    info_.text_hash = hash_of(function, name);
    info_.black_box = true;
    if (const nb::object text = function.attr("__doc__"); !text.is_none()) info_.summary = nb::cast<std::string>(text);
    function_ = share(std::move(function));
  }
  const ShaderInfo& info() const override { return info_; }
  const ParameterValues& parameters() const override { return parameters_; }
  std::unique_ptr<BoundPatterns> bind(const SurfacePoints& points) const override {
    return std::make_unique<PythonPatterns>(function_, info_.name, points);
  }

 private:
  ShaderInfo info_;
  ParameterValues parameters_;
  SharedFunction function_;
};

}  // namespace

std::shared_ptr<const Shader> make_python_shader(nb::callable function, const std::string& name) {
  return std::make_shared<PythonShader>(std::move(function), name);
}

}  // namespace redmap::python
