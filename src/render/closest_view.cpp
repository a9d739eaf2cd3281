// Some rays a frame, their footprints as those of the renderer, and of each object the narrowest.
#include "render/closest_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "map/pyramid.h"
#include "render/hit_footprint.h"
#include "render/tracer.h"
#include "surface/map_size.h"

namespace redmap {

namespace {

/// Rays along the longer side of a frame: places where the map is looked up change little from one to the next.
constexpr int kRaysAcross = 128;

/// Surfaces seen one behind the other, as far as they are transparent.
constexpr int kLayers = 4;

/// Of a frame's footprints on an object, the part that may be narrower than its texels: stretched slivers.
constexpr double kIgnored = 0.01;

/// Texels across at which the shorter side of a footprint is one texel: for every hit on each object of a frame.
using NeededTexels = std::vector<std::vector<float>>;

class FrameProbe {
 public:
  FrameProbe(const Scene& scene, const Tracer& tracer)
      : scene_(scene),
        tracer_(tracer),
        camera_(make_camera_rays(scene.camera)),
        step_(static_cast<float>(std::max(scene.camera.width, scene.camera.height)) / kRaysAcross) {}

  NeededTexels run() const {
    NeededTexels needed(scene_.objects.size());
    const int columns = rays(scene_.camera.width), rows = rays(scene_.camera.height);
    for (int j = 0; j < rows; ++j)
      for (int i = 0; i < columns; ++i)
        follow((static_cast<float>(i) + 0.5f) * step_, (static_cast<float>(j) + 0.5f) * step_, needed);
    return needed;
  }

 private:
  int rays(int pixels) const { return std::max(1, static_cast<int>(static_cast<float>(pixels) / step_)); }

  void follow(float x, float y, NeededTexels& needed) const {
    Ray ray{camera_.origin, normalized(camera_.unnormalised(x, y))};
    for (int layer = 0; layer < kLayers; ++layer) {
      RayHit hit;
      tracer_.intersect({&ray, 1}, {&hit, 1});
      if (hit.object == kNoObject) return;
      needed[hit.object].push_back(texels_needed(ray, hit, x, y));
      if (!scene_.objects[hit.object].shader->info().transmits) return;
      constexpr float kPast = 1e-4f;  // well past the surface, short of the next
      ray.t_near = hit.t * (1 + kPast);
    }
  }

  float texels_needed(const Ray& ray, const RayHit& hit, float x, float y) const {
    const Surface& surface = *scene_.objects[hit.object].surface;
    const Placement& placement = tracer_.placement(hit.object);
    SurfaceHit at;
    surface.complete({&hit.where, 1}, {&at, 1});
    const DirectionDifferential world = direction_differential(camera_, x, y);
    const Vec3 direction = normalized(placement.direction_object(ray.direction));
    const float distance = length(at.position - placement.point_object(ray.origin));
    const Footprint footprint = camera_footprint(
        at, direction, {placement.direction_object(world.dx), placement.direction_object(world.dy)}, distance, 1);
    return kLargestMapSize / footprint_axes(footprint, surface.map_extent(kLargestMapSize)).minor;
  }

  const Scene& scene_;
  const Tracer& tracer_;
  CameraRays camera_;
  float step_;
};

/// The largest of `values` but for the part that is ignored; 0 if there are none. Reorders them.
float largest_but_few(std::vector<float>& values) {
  if (values.empty()) return 0;
  const auto at = values.begin() + static_cast<std::ptrdiff_t>((1 - kIgnored) * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

struct ClosestView {
  float texels = 0;  ///< across the map; 0: never seen
  int frame = 0;
};

/// By object of the scene.
std::vector<ClosestView> find_closest_views(const SceneFile& file, const std::function<bool()>& stop) {
  Scene scene = file.at(1);
  std::vector<ClosestView> closest(scene.objects.size());
  Tracer tracer(scene);
  for (int frame = 1; frame <= file.frame_count() && !(stop && stop()); ++frame) {
    scene = file.at(frame);
    tracer.set_frame(scene);
    NeededTexels needed = FrameProbe(scene, tracer).run();
    for (std::size_t i = 0; i < closest.size(); ++i)
      if (const float texels = largest_but_few(needed[i]); texels > closest[i].texels) closest[i] = {texels, frame};
  }
  return closest;
}

SettledMapSize settle(const Object& object, const ClosestView& view) {
  if (object.texels_per_unit > 0)
    return {object.name, map_size_for_density(*object.surface, object.texels_per_unit),
            fmt::format("{:g} texels a unit of length", object.texels_per_unit)};
  if (!(view.texels > 0)) return {object.name, Object{}.map_size, "no frame shows it"};
  const int size = map_size_of_at_least(view.texels);
  const bool enough = static_cast<float>(size) >= view.texels;
  return {object.name, size,
          fmt::format("its pixels are smallest in frame {}, {:.0f} to a map{}", view.frame, view.texels,
                      enough ? "" : ": more than a map can have")};
}

}  // namespace

std::vector<SettledMapSize> settle_map_sizes(SceneFile& file, const std::function<bool()>& stop) {
  const std::vector<Object> objects = file.at(1).objects;
  const auto needs_view = [](const Object& o) { return o.map_size == kAutoMapSize && !(o.texels_per_unit > 0); };
  std::vector<ClosestView> views(objects.size());
  if (std::any_of(objects.begin(), objects.end(), needs_view)) views = find_closest_views(file, stop);
  std::vector<SettledMapSize> settled;
  if (stop && stop()) return settled;
  // Objects that share a map have the size that the one closest to the camera needs.
  std::map<std::filesystem::path, int> largest;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    if (objects[i].map_size != kAutoMapSize) continue;
    settled.push_back(settle(objects[i], views[i]));
    int& size = largest[objects[i].map_path];
    size = std::max(size, settled.back().size);
  }
  for (std::size_t i = 0, next = 0; i < objects.size(); ++i) {
    if (objects[i].map_size != kAutoMapSize) continue;
    settled[next].size = largest[objects[i].map_path];
    file.set_map_size(i, settled[next++].size);
  }
  return settled;
}

}  // namespace redmap
