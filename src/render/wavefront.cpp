#include "render/wavefront.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "render/hit_footprint.h"
#include "render/joined_hits.h"
#include "scene/layer_limits.h"

namespace redmap {

namespace {

/// Samples that have passed through the same number of transparent surfaces, and what they hit next.
struct Layer {
  std::vector<std::uint32_t> sample;
  std::vector<Rgb> throughput;
  std::vector<Ray> rays;
  std::vector<RayHit> hits;
};

/// Some of a layer's paths, all on one object. In the first layer path i is sample i with nothing before it.
struct Paths {
  const TracedSamples& traced;
  const Layer* layer;  ///< null: the first
  std::span<const std::uint32_t> members;

  std::size_t size() const { return members.size(); }
  std::uint32_t sample(std::size_t i) const { return layer ? layer->sample[members[i]] : members[i]; }
  Rgb throughput(std::size_t i) const { return layer ? layer->throughput[members[i]] : Rgb{1, 1, 1}; }
  const Ray& ray(std::size_t i) const { return (layer ? layer->rays : traced.rays)[members[i]]; }
  const RayHit& hit(std::size_t i) const { return (layer ? layer->hits : traced.hits)[members[i]]; }
};

/// `members` of `hits`, sorted by object without changing the order on each: those on object o are at
/// [starts[o], starts[o + 1]), misses at the end.
struct ByObject {
  std::vector<std::uint32_t> indices, starts;
};
ByObject sort_by_object(std::span<const RayHit> hits, std::span<const std::uint32_t> members, std::size_t objects) {
  const auto slot = [&](std::uint32_t i) { return std::min<std::size_t>(hits[i].object, objects); };
  ByObject sorted{std::vector<std::uint32_t>(members.size()), std::vector<std::uint32_t>(objects + 2, 0)};
  for (std::uint32_t i : members) ++sorted.starts[slot(i) + 1];
  for (std::size_t o = 0; o <= objects; ++o) sorted.starts[o + 1] += sorted.starts[o];
  std::vector<std::uint32_t> next(sorted.starts.begin(), sorted.starts.end() - 1);
  for (std::uint32_t i : members) sorted.indices[next[slot(i)]++] = i;
  return sorted;
}

std::vector<std::uint32_t> all_indices(std::size_t count) {
  std::vector<std::uint32_t> indices(count);
  std::iota(indices.begin(), indices.end(), 0u);
  return indices;
}

/// Of rays that leave `object`, without what the roundings add.
float offset_of(const Object& object) {
  return kRayOffset * 0.5f * length(object.surface->upper() - object.surface->lower()) * object.transform.scale;
}
/// `reach`: the largest distance or coordinate that the hit was computed from.
float offset_of(const Object& object, float reach) { return offset_of(object) + kRoundings * reach; }

/// Places `paths` on their surface, normals turned towards the viewer.
void place_hits(const FrameContext& frame, const Paths& paths, ShadingBatch& batch) {
  const std::uint32_t object = paths.hit(0).object;
  const Placement& placement = frame.tracer->placement(object);
  std::vector<HitCoordinates> where(paths.size());
  for (std::size_t i = 0; i < paths.size(); ++i) where[i] = paths.hit(i).where;
  batch.hits.resize(paths.size());
  frame.scene->objects[object].surface->complete(where, batch.hits);

  const std::size_t count = paths.size();
  batch.turned.resize(count), batch.frames.resize(count), batch.to_viewer.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    SurfaceHit& hit = batch.hits[i];
    batch.to_viewer[i] = -placement.direction_object(paths.ray(i).direction);
    batch.turned[i] = dot(hit.geometric_normal, batch.to_viewer[i]) < 0;
    if (batch.turned[i]) hit.normal = -hit.normal, hit.geometric_normal = -hit.geometric_normal;
    batch.frames[i] = {hit.tangent, cross(hit.normal, hit.tangent), hit.normal};
  }
}

/// The footprints of placed hits.
void find_footprints(const FrameContext& frame, const Paths& paths, ShadingBatch& batch) {
  const Placement& placement = frame.tracer->placement(paths.hit(0).object);
  const Vec3 eye = placement.point_object(frame.camera.origin);
  const bool given = !paths.layer && !paths.traced.footprints.empty();
  batch.footprints.resize(paths.size());
  for (std::size_t i = 0; i < paths.size(); ++i) {
    if (given) {
      batch.footprints[i] = paths.traced.footprints[paths.sample(i)];
      continue;
    }
    const CameraSample& sample = paths.traced.samples[paths.sample(i)];
    const DirectionDifferential world = direction_differential(frame.camera, sample.x, sample.y);
    batch.footprints[i] = camera_footprint(batch.hits[i], -batch.to_viewer[i],
                                           {placement.direction_object(world.dx), placement.direction_object(world.dy)},
                                           length(batch.hits[i].position - eye), sample.extent);
  }
}

/// Light `light` as it arrives at every hit of the batch, shadows included.
void light_hits(const FrameContext& frame, const Paths& paths, const Light& light, ShadingBatch& batch,
                ShadingBatch::Light& lit, RenderCounts& counts) {
  const Object& object = frame.scene->objects[paths.hit(0).object];
  const Placement& placement = frame.tracer->placement(paths.hit(0).object);
  lit.to_light.resize(paths.size());
  lit.irradiance = Planes<3>(paths.size());
  const float object_offset = offset_of(object);

  std::vector<Ray> shadow_rays;
  std::vector<float> widths;
  std::vector<std::uint32_t> owner;
  for (std::uint32_t i = 0; i < paths.size(); ++i) {
    const SurfaceHit& hit = batch.hits[i];
    const Vec3 position = placement.point_world(hit.position);
    const float offset = object_offset + kRoundings * std::max(paths.hit(i).t, length(position));
    const bool point = light.type == Light::Type::kPoint;
    const Vec3 path = point ? light.position - position : light.to_light;
    const float distance = point ? length(path) : std::numeric_limits<float>::max();
    const Vec3 direction = normalized(path);
    lit.to_light[i] = placement.direction_object(direction);
    const Vec3 normal = placement.direction_world(hit.geometric_normal);
    // A face turned away from the light shadows itself.
    if (light.shadows && dot(normal, direction) <= 0) continue;
    const Rgb irradiance = point ? light.intensity * (1 / (distance * distance)) : light.intensity;
    lit.irradiance.set(i, Vec3{irradiance.r, irradiance.g, irradiance.b});
    if (!light.shadows) continue;
    shadow_rays.push_back({position + normal * offset, direction, 0, point ? distance - offset : distance});
    widths.push_back(length(position - frame.camera.origin) * frame.camera.pixel_angle *
                     paths.traced.samples[paths.sample(i)].extent);
    owner.push_back(i);
  }
  const std::vector<Rgb> passed = transmittance_along(frame, std::move(shadow_rays), widths, counts);
  for (std::size_t k = 0; k < owner.size(); ++k) {
    const Vec3 e = lit.irradiance.get(owner[k]);
    lit.irradiance.set(owner[k], Vec3{e.x * passed[k].r, e.y * passed[k].g, e.z * passed[k].b});
  }
}

void record_views(const FrameContext& frame, const Paths& paths, const ShadingBatch& batch,
                  std::vector<SampleView>& views) {
  const Placement& placement = frame.tracer->placement(paths.hit(0).object);
  for (std::size_t i = 0; i < paths.size(); ++i) {
    SampleView& view = views[paths.sample(i)];
    view.chart = batch.hits[i].chart;
    view.position = placement.point_world(batch.hits[i].position);
    view.geometric_normal = placement.direction_world(batch.hits[i].geometric_normal);
    for (std::size_t l = 0; l < batch.lights.size(); ++l) {
      const Vec3 e = batch.lights[l].irradiance.get(i);
      if (e.x + e.y + e.z > 0) view.lit |= 1u << std::min<std::size_t>(l, 31);
    }
  }
}

void add_light(const CameraSample& sample, Rgb light, float* rgb) {
  float* pixel = rgb + 3 * static_cast<std::size_t>(sample.pixel);
  pixel[0] += sample.weight * light.r;
  pixel[1] += sample.weight * light.g;
  pixel[2] += sample.weight * light.b;
}

/// False if the pixel was handed back, and the sample counts nothing.
bool record_decision(std::uint32_t pixel, Decision decision, const PixelSums& pixels) {
  if (pixels.decisions) pixels.decisions[pixel] = std::max(pixels.decisions[pixel], decision);
  const bool deferred = pixels.deferred && decision == Decision::kSupersampled;
  if (deferred) pixels.deferred->push_back(pixel);
  return !deferred;
}

/// Adds what hits were shaded to: hit i is that of path owner[i] and of as many as it `stands_for` (owner empty: of
/// path i alone). What passes goes on behind them, in `onward`.
void receive(const FrameContext& frame, const Paths& paths, const ShadedBatch& shaded,
             std::span<const std::uint32_t> owner, float stands_for, const PixelSums& pixels, Layer& onward) {
  for (std::size_t i = 0; i < shaded.decisions.size(); ++i) {
    const std::size_t path = owner.empty() ? i : owner[i];
    if (path == kTakenApart) continue;
    const CameraSample& sample = paths.traced.samples[paths.sample(path)];
    if (!paths.layer && !record_decision(sample.pixel, shaded.decisions[i], pixels)) continue;
    if (pixels.apart && !paths.layer && frame.shading[paths.hit(path).object]->takes_apart(shaded.decisions[i])) {
      pixels.apart->push_back(sample.pixel);
      continue;
    }
    add_light(sample, paths.throughput(path) * shaded.radiance.rgb(i) * stands_for, pixels.rgb);
    const Rgb throughput = paths.throughput(path) * shaded.transmittance.rgb(i);
    if (std::max({throughput.r, throughput.g, throughput.b}) < kLeastThroughput) continue;
    const RayHit& hit = paths.hit(path);
    Ray ray = paths.ray(path);
    ray.t_near = hit.t + offset_of(frame.scene->objects[hit.object], hit.t);
    onward.sample.push_back(paths.sample(path));
    onward.throughput.push_back(throughput);
    onward.rays.push_back(ray);
  }
}

/// Squares of samples shaded as one; empty where the object's shading takes none.
JoinedHits join_paths(const FrameContext& frame, const Paths& paths, const ShadingBatch& batch) {
  const std::uint32_t object = paths.hit(0).object;
  const float square = 2 * paths.traced.samples[paths.sample(0)].extent;
  if (square > frame.joined_pixels || paths.layer || !paths.traced.footprints.empty()) return {};
  return join_hits(paths.traced.samples, paths.members, batch, frame.joined_pixels, *frame.shading[object],
                   frame.scene->objects[object].surface->wraps_u());
}

/// Where the quarters of each footprint are, as if they were joined hits.
void quarter_footprints(ShadingBatch& batch) {
  for (const Footprint& f : batch.footprints) {
    const Vec2 x = f.duv_dx * 0.25f, y = f.duv_dy * 0.25f;
    batch.parts.push_back({f.uv - x - y, f.uv + x - y, f.uv - x + y, f.uv + x + y});
  }
}

/// Shades paths on one object, and appends those that go on behind it to `onward`.
void shade_object(const FrameContext& frame, const Paths& paths, const PixelSums& pixels, RenderCounts& counts,
                  std::vector<SampleView>* views, Layer& onward) {
  ShadingBatch batch;
  batch.time = frame.scene->time_seconds;
  batch.may_defer = pixels.deferred && !paths.layer;
  place_hits(frame, paths, batch);
  batch.lights.resize(frame.scene->lights.size());
  for (std::size_t l = 0; l < batch.lights.size(); ++l)
    light_hits(frame, paths, frame.scene->lights[l], batch, batch.lights[l], counts);
  if (views && !paths.layer) record_views(frame, paths, batch, *views);

  const ObjectShading& shading = *frame.shading[paths.hit(0).object];
  ShadedBatch shaded;
  JoinedHits joined = join_paths(frame, paths, batch);
  if (joined.first.empty()) {
    if (shading.needs_footprints()) find_footprints(frame, paths, batch);
    if (frame.quarters && !paths.layer && paths.traced.samples[paths.sample(0)].extent == 1) quarter_footprints(batch);
    shading.shade(batch, shaded, counts);
    return receive(frame, paths, shaded, {}, 1, pixels, onward);
  }
  shading.shade(joined.batch, shaded, counts);
  take_apart(shading, shaded.decisions, joined);
  receive(frame, paths, shaded, joined.first, kJoined, pixels, onward);
  if (joined.single.empty()) return;
  ShadingBatch singles = select(batch, joined.single);
  std::vector<std::uint32_t> members;
  for (const std::uint32_t i : joined.single) members.push_back(paths.members[i]);
  find_footprints(frame, {paths.traced, paths.layer, members}, singles);
  shading.shade(singles, shaded, counts);
  receive(frame, paths, shaded, joined.single, 1, pixels, onward);
}

/// Shades what the paths `all` of one layer hit; what goes on lands in `onward`.
void shade_layer(const FrameContext& frame, const TracedSamples& traced, const Layer* layer,
                 std::span<const std::uint32_t> all, const PixelSums& pixels, RenderCounts& counts,
                 std::vector<SampleView>* views, Layer& onward) {
  const std::size_t objects = frame.scene->objects.size();
  const ByObject sorted = sort_by_object(layer ? layer->hits : traced.hits, all, objects);
  const auto members = [&](std::size_t o) {
    return std::span(sorted.indices).subspan(sorted.starts[o], sorted.starts[o + 1] - sorted.starts[o]);
  };
  for (std::size_t o = 0; o < objects; ++o)
    if (!members(o).empty()) shade_object(frame, {traced, layer, members(o)}, pixels, counts, views, onward);
  const Paths missed{traced, layer, members(objects)};
  for (std::size_t i = 0; i < missed.size(); ++i)
    add_light(traced.samples[missed.sample(i)], missed.throughput(i) * frame.scene->background, pixels.rgb);
}

/// Lets the rays that hit `object` through as far as it transmits, and on to what lies behind. False if none did.
bool pass_object(const FrameContext& frame, std::uint32_t object, std::span<const RayHit> hits,
                 std::span<const float> widths, std::vector<Ray>& rays, std::vector<Rgb>& passed) {
  std::vector<std::uint32_t> owner;
  std::vector<HitCoordinates> where;
  for (std::uint32_t i = 0; i < rays.size(); ++i)
    if (hits[i].object == object) owner.push_back(i), where.push_back(hits[i].where);
  if (owner.empty()) return false;

  const Object& hit_object = frame.scene->objects[object];
  std::vector<SurfaceHit> surface(owner.size());
  hit_object.surface->complete(where, surface);
  std::vector<Footprint> footprints(owner.size());
  for (std::size_t k = 0; k < owner.size(); ++k)
    footprints[k] = round_footprint(surface[k], widths[owner[k]] / hit_object.transform.scale);
  Planes<3> transmittance;
  frame.shading[object]->transmittance(surface, footprints, frame.scene->time_seconds, transmittance);
  for (std::size_t k = 0; k < owner.size(); ++k) {
    const std::uint32_t i = owner[k];
    passed[i] = passed[i] * transmittance.rgb(k);
    rays[i].t_near = hits[i].t + offset_of(hit_object, hits[i].t);
    if (passed[i] == Rgb{}) rays[i].t_far = -1;  // blocked: an empty interval is not traced again
  }
  return true;
}

}  // namespace

Ray camera_ray(const CameraRays& camera, const CameraSample& sample) {
  return {camera.origin, normalized(camera.unnormalised(sample.x, sample.y))};
}

void trace_samples(const FrameContext& frame, TracedSamples& traced, RenderCounts& counts) {
  traced.rays.resize(traced.samples.size());
  traced.hits.resize(traced.samples.size());
  for (std::size_t i = 0; i < traced.samples.size(); ++i) traced.rays[i] = camera_ray(frame.camera, traced.samples[i]);
  frame.tracer->intersect(traced.rays, traced.hits);
  counts.camera_rays += traced.rays.size();
}

void shade_samples(const FrameContext& frame, const TracedSamples& traced, std::span<const std::uint32_t> members,
                   const PixelSums& pixels, RenderCounts& counts, std::vector<SampleView>* views) {
  if (views) views->assign(traced.samples.size(), {});
  Layer layer, onward;
  shade_layer(frame, traced, nullptr, members, pixels, counts, views, onward);
  for (int depth = 1; depth < kMaxLayers && !onward.rays.empty(); ++depth) {
    layer = std::exchange(onward, {});
    layer.hits.resize(layer.rays.size());
    frame.tracer->intersect(layer.rays, layer.hits);
    counts.camera_rays += layer.rays.size();
    shade_layer(frame, traced, &layer, all_indices(layer.rays.size()), pixels, counts, views, onward);
  }
}

void shade_samples(const FrameContext& frame, const TracedSamples& traced, const PixelSums& pixels,
                   RenderCounts& counts, std::vector<SampleView>* views) {
  shade_samples(frame, traced, all_indices(traced.samples.size()), pixels, counts, views);
}

std::vector<Rgb> transmittance_along(const FrameContext& frame, std::vector<Ray> rays, std::span<const float> widths,
                                     RenderCounts& counts) {
  std::vector<Rgb> passed(rays.size(), Rgb{1, 1, 1});
  counts.shadow_rays += rays.size();
  if (!frame.transmits) {
    std::vector<std::uint8_t> blocked(rays.size());
    frame.tracer->occluded(rays, blocked);
    for (std::size_t i = 0; i < rays.size(); ++i)
      if (blocked[i]) passed[i] = {};
    return passed;
  }
  std::vector<RayHit> hits(rays.size());
  for (int layer = 0; layer < kMaxLayers; ++layer) {
    frame.tracer->intersect(rays, hits);
    bool any = false;
    for (std::uint32_t object = 0; object < frame.scene->objects.size(); ++object)
      any |= pass_object(frame, object, hits, widths, rays, passed);
    if (!any) return passed;
    counts.shadow_rays += rays.size();
  }
  return passed;
}

}  // namespace redmap
