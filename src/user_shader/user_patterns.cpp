#include "user_shader/user_patterns.h"

#include <algorithm>

namespace redmap {
namespace {

/// Most invocations of one dispatch: the results for all direction samples of a bake stay under 8 MB.
constexpr std::size_t kMostPlaces = 16384;

template <int N>
void append_rows(const Planes<N>& planes, std::size_t first, InputRows& in) {
  for (int c = 0; c < N; ++c) in.rows.push_back(planes[c] + first);
}

template <int N>
std::vector<float*> rows_of(Planes<N>& planes, std::size_t first) {
  std::vector<float*> rows;
  for (int c = 0; c < N; ++c) rows.push_back(planes[c] + first);
  return rows;
}

class UserPatterns final : public BoundPatterns {
 public:
  UserPatterns(std::shared_ptr<const UserShaderParts> shader, const SurfacePoints& points)
      : shader_(std::move(shader)),
        position_(points.position),
        bytes_(points.size() * shader_->program.pattern_size()),
        normals_(shader_->info.perturbs_normals ? points.size() : 0),
        tangents_(shader_->info.turns_tangents ? points.size() : 0) {
    for_each_batch(points.size(), [&](std::size_t first, std::size_t count) {
      InputRows in{{}, count};
      append_rows(points.position, first, in), append_rows(points.normal, first, in);
      append_rows(points.tangent, first, in), append_rows(points.uv, first, in);
      std::vector<float*> out;
      for (Planes<3>* declared : {&normals_, &tangents_})
        if (declared->size() > 0) std::ranges::copy(rows_of(*declared, first), std::back_inserter(out));
      StageCall call;
      call.time = points.time;
      run(Stage::kBind, call, in, first, count, out);
      check(first, [&] {
        if (normals_.size() > 0) require_unit(rows_of(normals_, first), count, "shading_normal");
        if (tangents_.size() > 0) require_unit(rows_of(tangents_, first), count, "shading_tangent");
      });
    });
  }

  std::size_t size() const override { return position_.size(); }

  void radiance_each(const DirectionPairs& pairs, Planes<3>& out) const override {
    out.resize(size());
    for_each_batch(size(), [&](std::size_t first, std::size_t count) {
      const std::vector<float*> rows = rows_of(out, first);
      run(Stage::kRadiance, {}, directions(pairs, first, count), first, count, rows);
      check(first, [&] { require_finite(rows, count, "radiance"); });
    });
  }

  void radiance_one(std::size_t pattern, const DirectionPairs& pairs, Planes<3>& out) const override {
    out.resize(pairs.size());
    for_each_batch(pairs.size(), [&](std::size_t first, std::size_t count) {
      const std::vector<float*> rows = rows_of(out, first);
      StageCall call;
      call.pairing = Pairing::kOnePattern;
      call.places = static_cast<std::uint32_t>(count);
      // Whatever happens, it happens at the one place.
      named([&](std::size_t) { return position_.get(pattern); },
            [&] {
              shader_->program.run(Stage::kRadiance, call, directions(pairs, first, count), patterns(pattern, 1), rows);
              require_finite(rows, count, "radiance");
            });
    });
  }

  void radiance_all(const DirectionPairs& pairs, LaneVector<float>& out) const override {
    const std::size_t stride = padded(size());
    out.resize(pairs.size() * 3 * stride);
    for_each_batch(size(), [&](std::size_t first, std::size_t count) {
      std::vector<float*> rows;
      for (std::size_t r = 0; r < 3 * pairs.size(); ++r) rows.push_back(out.data() + r * stride + first);
      StageCall call;
      call.pairing = Pairing::kAll;
      call.pairs = static_cast<std::uint32_t>(pairs.size());
      run(Stage::kRadiance, call, directions(pairs, 0, pairs.size()), first, count, rows);
      check(first, [&] { require_finite(rows, count, "radiance"); });
    });
  }

  void transmittance(Planes<3>& out) const override {
    out = Planes<3>(size());
    if (shader_->info.transmits) constants("transmittance", [&](auto& all) { copy(all, 0, out); });
  }
  void emission(Planes<3>& out) const override {
    out = Planes<3>(size());
    if (shader_->info.emits) constants("emission", [&](auto& all) { copy(all, 3, out); });
  }
  bool materials(Materials& out) const override {
    if (!shader_->info.has_material) return false;
    out = {};
    out.resize(size());
    constants("material", [&](auto& all) {
      copy(all, 6, out.diffuse), copy(all, 9, out.specular), copy(all, 12, out.transmittance);
      copy(all, 15, out.exponent), copy(all, 16, out.ggx), copy(all, 17, out.grazing), copy(all, 18, out.roughness);
    });
    return true;
  }
  bool shading_normals(Planes<3>& out) const override { return give(normals_, out); }
  bool shading_tangents(Planes<3>& out) const override { return give(tangents_, out); }

 private:
  using Constants = Planes<kConstantRows>;

  template <typename Body>
  static void for_each_batch(std::size_t size, const Body& body) {
    for (std::size_t first = 0; first < size; first += kMostPlaces) body(first, std::min(kMostPlaces, size - first));
  }
  static bool give(const Planes<3>& from, Planes<3>& out) {
    if (from.size() == 0) return false;
    out = from;
    return true;
  }
  static InputRows directions(const DirectionPairs& pairs, std::size_t first, std::size_t count) {
    InputRows in{{}, count};
    append_rows(pairs.to_light, first, in), append_rows(pairs.to_viewer, first, in);
    return in;
  }
  template <int N>
  static void copy(const Constants& from, int row, Planes<N>& to) {
    for (int c = 0; c < N; ++c) std::copy_n(from[row + c], from.size(), to[c]);
  }

  std::span<std::byte> patterns(std::size_t first, std::size_t count) const {
    const std::size_t size_each = shader_->program.pattern_size();
    return std::span(bytes_).subspan(first * size_each, count * size_each);
  }
  /// Errors get the shader's name, and the position of the place where there is one.
  template <typename Position, typename Body>
  void named(const Position& position, const Body& body) const {
    try {
      body();
    } catch (const FunctionError& error) {
      fail_at(error, shader_->info.name, position(error.place()));
    } catch (const Error& error) {
      throw Error("shader \"{}\": {}", shader_->info.name, error.what());
    }
  }
  /// Places are counted from `first`.
  template <typename Body>
  void check(std::size_t first, const Body& body) const {
    named([&](std::size_t place) { return position_.get(first + place); }, body);
  }
  void run(Stage stage, StageCall call, const InputRows& in, std::size_t first, std::size_t count,
           std::span<float* const> out) const {
    call.places = static_cast<std::uint32_t>(count);
    check(first, [&] { shader_->program.run(stage, call, in, patterns(first, count), out); });
  }
  template <typename Use>
  void constants(std::string_view function, const Use& use) const {
    Constants all(size());
    for_each_batch(size(), [&](std::size_t first, std::size_t count) {
      const std::vector<float*> rows = rows_of(all, first);
      run(Stage::kConstants, {}, {}, first, count, rows);
      check(first, [&] { require_finite(rows, count, function); });
    });
    use(all);
  }

  std::shared_ptr<const UserShaderParts> shader_;
  Planes<3> position_;
  mutable std::vector<std::byte> bytes_;  ///< written by the constructor alone
  Planes<3> normals_, tangents_;          ///< of shaders that declare them
};

}  // namespace

std::unique_ptr<BoundPatterns> bind_user_patterns(std::shared_ptr<const UserShaderParts> shader,
                                                  const SurfacePoints& points) {
  return std::make_unique<UserPatterns>(std::move(shader), points);
}

}  // namespace redmap
