// Scenes and a shader whose pictures are known without rendering them.
#pragma once

#include <memory>

#include "render/renderer.h"

namespace redmap::test {

/// Lambert of one albedo everywhere, letting `transmittance` of the light from behind through.
class LambertShader : public Shader {
 public:
  LambertShader(float albedo, float transmittance) : albedo_(albedo), transmittance_(transmittance) {
    info_.name = "test_lambert";
    info_.transmits = transmittance > 0;
  }
  const ShaderInfo& info() const override { return info_; }
  const ParameterValues& parameters() const override { return parameters_; }
  std::unique_ptr<BoundPatterns> bind(const SurfacePoints& points) const override {
    return std::make_unique<Bound>(points.size(), albedo_, transmittance_);
  }

 private:
  class Bound : public BoundPatterns {
   public:
    Bound(std::size_t size, float albedo, float transmittance)
        : size_(size), albedo_(albedo), transmittance_(transmittance) {}
    std::size_t size() const override { return size_; }
    void radiance_each(const DirectionPairs& pairs, Planes<3>& out) const override {
      out.resize(pairs.size());
      for (std::size_t i = 0; i < pairs.size(); ++i) {
        const float value = albedo_ * std::max(0.0f, pairs.to_light.get(i).z) / kPi;
        out.set(i, Vec3{value, value, value});
      }
    }
    void radiance_one(std::size_t, const DirectionPairs& pairs, Planes<3>& out) const override {
      radiance_each(pairs, out);
    }
    void radiance_all(const DirectionPairs&, LaneVector<float>&) const override {}
    void transmittance(Planes<3>& out) const override { fill(out, transmittance_); }
    void emission(Planes<3>& out) const override { fill(out, 0); }
    bool materials(Materials&) const override { return false; }

   private:
    void fill(Planes<3>& out, float value) const {
      out.resize(size_);
      for (std::size_t i = 0; i < size_; ++i) out.set(i, Vec3{value, value, value});
    }
    std::size_t size_;
    float albedo_, transmittance_;
  };

  float albedo_, transmittance_;
  ShaderInfo info_;
  ParameterValues parameters_;
};

/// A unit sphere at the origin seen from +z, one directional light of irradiance 1 from `to_light`.
inline Scene sphere_scene(std::shared_ptr<const Shader> shader, Vec3 to_light, int pixels = 64) {
  Scene scene;
  Object ball;
  ball.name = "ball";
  ball.surface = make_sphere(1);
  ball.shader = std::move(shader);
  scene.objects.push_back(ball);
  Light light;
  light.type = Light::Type::kDirectional;
  light.to_light = normalized(to_light);
  scene.lights.push_back(light);
  scene.camera.width = scene.camera.height = pixels;
  return scene;
}

/// A map with two basis reflectances, the shader's at two places, and weights that alternate from texel to texel.
inline std::shared_ptr<const ReductionMap> alternating_map(const Object& object, BasisPlace first, BasisPlace second,
                                                           int size) {
  auto map = std::make_shared<ReductionMap>();
  map->shader = object.shader->info().name;
  for (std::size_t i = 0; i < object.shader->parameters().size(); ++i)
    map->parameters[object.shader->info().parameters[i].name] = object.shader->parameters()[i];
  map->shader_hash = object.shader->info().text_hash;
  map->surface_fingerprint = object.surface->fingerprint();
  map->size = size;
  map->basis = {first, second};
  const Extent extent = object.surface->map_extent(size);
  BaseLevel base(extent, 2, object.surface->wraps_u());
  for (int y = 0; y < extent.height; ++y)
    for (int x = 0; x < extent.width; ++x) {
      const std::size_t texel = static_cast<std::size_t>(y) * extent.width + x;
      base.coverage[texel] = 1;
      base.values[2 * texel + (x + y) % 2] = 1;
    }
  map->weights = WeightPyramid(base);
  return map;
}

}  // namespace redmap::test
