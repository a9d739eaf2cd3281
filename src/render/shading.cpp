#include "render/shading.h"

namespace redmap {

RenderCounts& RenderCounts::operator+=(const RenderCounts& other) {
  camera_rays += other.camera_rays;
  shadow_rays += other.shadow_rays;
  shader_calls += other.shader_calls;
  lookups += other.lookups;
  supersampled_pixels += other.supersampled_pixels;
  return *this;
}

DirectionPairs pairs_in_frames(const ShadingBatch& batch, std::size_t light, std::span<const Frame> frames) {
  DirectionPairs pairs;
  pairs.resize(batch.size());
  for (std::size_t i = 0; i < batch.size(); ++i) {
    pairs.to_light.set(i, frames[i].to_local(batch.lights[light].to_light[i]));
    pairs.to_viewer.set(i, frames[i].to_local(batch.to_viewer[i]));
  }
  return pairs;
}

void add_lit(const float* weight, const Planes<3>& radiance, const Planes<3>& irradiance, Planes<3>& sum) {
  const std::size_t count = sum.stride();
  for (int c = 0; c < 3; ++c) {
    float* out = sum[c];
    const float *r = radiance[c], *e = irradiance[c];
    if (weight)
      for (std::size_t i = 0; i < count; ++i) out[i] += weight[i] * r[i] * e[i];
    else
      for (std::size_t i = 0; i < count; ++i) out[i] += r[i] * e[i];
  }
}

ShadingBatch select(const ShadingBatch& batch, std::span<const std::uint32_t> indices) {
  const auto pick = [&](const auto& from, auto& to) {
    to.reserve(indices.size());
    for (std::uint32_t i : indices) to.push_back(from[i]);
  };
  ShadingBatch part;
  part.time = batch.time, part.may_defer = batch.may_defer;
  pick(batch.hits, part.hits), pick(batch.turned, part.turned), pick(batch.frames, part.frames);
  if (!batch.footprints.empty()) pick(batch.footprints, part.footprints);
  pick(batch.to_viewer, part.to_viewer);
  if (!batch.parts.empty()) pick(batch.parts, part.parts);
  part.lights.resize(batch.lights.size());
  for (std::size_t light = 0; light < batch.lights.size(); ++light) {
    pick(batch.lights[light].to_light, part.lights[light].to_light);
    part.lights[light].irradiance.resize(indices.size());
    for (std::size_t i = 0; i < indices.size(); ++i)
      part.lights[light].irradiance.set(i, batch.lights[light].irradiance.get(indices[i]));
  }
  return part;
}

void scatter(const ShadedBatch& from, std::span<const std::uint32_t> indices, ShadedBatch& to) {
  for (std::size_t i = 0; i < indices.size(); ++i) {
    to.radiance.set(indices[i], from.radiance.get(i));
    to.transmittance.set(indices[i], from.transmittance.get(i));
  }
}

namespace {

/// Shaders see the surface at rest; `turned` (or nothing): hits whose normal looks the other way.
SurfacePoints points_at_rest(std::span<const SurfaceHit> hits, std::span<const std::uint8_t> turned, float time) {
  SurfacePoints points;
  points.resize(hits.size());
  points.time = time;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    points.position.set(i, hits[i].rest.position);
    points.normal.set(i, !turned.empty() && turned[i] ? -hits[i].rest.normal : hits[i].rest.normal);
    points.tangent.set(i, hits[i].rest.tangent);
    points.uv.set(i, hits[i].uv);
  }
  return points;
}

/// A direction at a hit, from the surface at rest to its pose.
Vec3 carried_by_pose(const SurfaceHit& hit, bool turned, Vec3 direction) {
  const Vec3 rest_normal = turned ? -hit.rest.normal : hit.rest.normal;
  if (rest_normal == hit.normal && hit.rest.tangent == hit.tangent) return direction;
  const Frame rest = make_frame(rest_normal, hit.rest.tangent), posed = make_frame(hit.normal, hit.tangent);
  return posed.to_world(rest.to_local(direction));
}

}  // namespace

SurfacePoints surface_points(const ShadingBatch& batch) { return points_at_rest(batch.hits, batch.turned, batch.time); }

std::vector<Frame> shading_frames(const ShadingBatch& batch, const BoundPatterns& patterns) {
  Planes<3> normals, tangents;
  const bool has_normals = patterns.shading_normals(normals), has_tangents = patterns.shading_tangents(tangents);
  std::vector<Frame> frames = batch.frames;
  if (!has_normals && !has_tangents) return frames;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const auto carried = [&](Vec3 direction) {
      return carried_by_pose(batch.hits[i], batch.turned[i] != 0, direction);
    };
    frames[i] = make_frame(has_normals ? carried(normals.get(i)) : frames[i].z,
                           has_tangents ? carried(tangents.get(i)) : frames[i].x);
  }
  return frames;
}

namespace {

class ShaderShading : public ObjectShading {
 public:
  explicit ShaderShading(std::shared_ptr<const Shader> shader) : shader_(std::move(shader)) {}

  void shade(const ShadingBatch& batch, ShadedBatch& out, RenderCounts& counts) const override {
    const auto patterns = shader_->bind(surface_points(batch));
    if (shader_->info().emits)
      patterns->emission(out.radiance);
    else
      out.radiance = Planes<3>(batch.size());
    const std::vector<Frame> frames = shading_frames(batch, *patterns);
    Planes<3> radiance;
    for (std::size_t light = 0; light < batch.lights.size(); ++light) {
      patterns->radiance_each(pairs_in_frames(batch, light, frames), radiance);
      add_lit(nullptr, radiance, batch.lights[light].irradiance, out.radiance);
    }
    counts.shader_calls += batch.size() * batch.lights.size();
    out.decisions.assign(batch.size(), Decision::kOriginal);
    if (shader_->info().transmits)
      patterns->transmittance(out.transmittance);
    else
      out.transmittance = Planes<3>(batch.size());
  }

  bool needs_footprints() const override { return false; }

  void transmittance(std::span<const SurfaceHit> hits, std::span<const Footprint>, float time,
                     Planes<3>& out) const override {
    if (shader_->info().transmits)
      shader_->bind(points_at_rest(hits, {}, time))->transmittance(out);
    else
      out = Planes<3>(hits.size());
  }

 private:
  std::shared_ptr<const Shader> shader_;
};

}  // namespace

std::unique_ptr<ObjectShading> make_shader_shading(std::shared_ptr<const Shader> shader) {
  return std::make_unique<ShaderShading>(std::move(shader));
}

}  // namespace redmap
