// A surface and a shader of which everything is known: a square, and mixtures of three reflectances.
#pragma once

#include <functional>
#include <memory>
#include <utility>

#include "shader/patterns_by_function.h"
#include "surface/surface.h"

namespace redmap {

/// The unit square z = 0, position = (u, v, 0), as far as u < `covered_u`.
class SquareSurface : public Surface {
 public:
  explicit SquareSurface(float covered_u = 1) : covered_u_(covered_u) {}
  Extent map_extent(int size) const override { return {size, size}; }
  bool wraps_u() const override { return false; }
  double area() const override { return covered_u_; }
  double uv_area() const override { return covered_u_; }
  void rasterize(Extent extent, TexelRegion region, std::span<const Vec2> offsets, std::span<const std::uint8_t> wanted,
                 TexelPoints& out) const override {
    std::vector<Vec2> uv;
    out.texel.clear();
    for (int i = 0; i < region.width * region.height; ++i)
      for (Vec2 offset : offsets) {
        const float u = (static_cast<float>(region.x + i % region.width) + offset.x) / static_cast<float>(extent.width);
        const float v =
            (static_cast<float>(region.y + i / region.width) + offset.y) / static_cast<float>(extent.height);
        if (u >= covered_u_ || (!wanted.empty() && !wanted[i])) continue;
        uv.push_back({u, v});
        out.texel.push_back(static_cast<std::uint32_t>(i));
      }
    out.points.resize(uv.size());
    for (std::size_t i = 0; i < uv.size(); ++i) {
      out.points.position.set(i, Vec3{uv[i].x, uv[i].y, 0});
      out.points.normal.set(i, Vec3{0, 0, 1});
      out.points.tangent.set(i, Vec3{1, 0, 0});
      out.points.uv.set(i, uv[i]);
    }
  }
  void complete(std::span<const HitCoordinates>, std::span<SurfaceHit>) const override {}
  std::optional<AnalyticHit> intersect(Vec3, Vec3, float, float) const override { return std::nullopt; }
  Vec3 lower() const override { return {0, 0, 0}; }
  Vec3 upper() const override { return {1, 1, 0}; }
  std::uint64_t fingerprint() const override { return 42; }

 private:
  float covered_u_;
};

/// Weights of the three planted reflectances at a place: red Lambert, green Lambert squared, blue of the viewer's
/// cosine.
using PlantedWeights = std::function<Vec3(Vec3 position)>;

class PlantedPatterns : public PatternsByFunction {
 public:
  PlantedPatterns(const SurfacePoints& points, const PlantedWeights& weights) : weights_(points.size()) {
    for (std::size_t i = 0; i < points.size(); ++i) weights_.set(i, weights(points.position.get(i)));
  }
  std::size_t size() const override { return weights_.size(); }

 private:
  Vec3 radiance(std::size_t pattern, const DirectionPairs& pairs, std::size_t pair) const override {
    const Vec3 w = weights_.get(pattern);
    const float light = std::max(0.0f, pairs.to_light[2][pair]), viewer = std::max(0.0f, pairs.to_viewer[2][pair]);
    return {w.x * light, w.y * light * light, w.z * viewer};
  }
  Planes<3> weights_;
};

class PlantedShader : public Shader {
 public:
  explicit PlantedShader(PlantedWeights weights) : weights_(std::move(weights)) { info_.name = "planted"; }
  const ShaderInfo& info() const override { return info_; }
  const ParameterValues& parameters() const override { return parameters_; }
  std::unique_ptr<BoundPatterns> bind(const SurfacePoints& points) const override {
    return std::make_unique<PlantedPatterns>(points, weights_);
  }

 private:
  PlantedWeights weights_;
  ShaderInfo info_;
  ParameterValues parameters_;
};

}  // namespace redmap
