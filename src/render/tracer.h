// Rays against the objects of a scene, through Embree: one structure a surface, built once, placed anew each frame.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "scene/placement.h"
#include "scene/scene.h"

namespace redmap {

inline constexpr std::uint32_t kNoObject = ~0u;

/// World space, unit direction.
struct Ray {
  Vec3 origin, direction;
  float t_near = 0, t_far = std::numeric_limits<float>::max();
};

struct RayHit {
  std::uint32_t object = kNoObject;  ///< index into Scene::objects
  HitCoordinates where;
  float t = 0;
  Vec3 geometric_normal;  ///< object space, not normalised
};

class Tracer {
 public:
  /// The surfaces of `scene.objects`; set_frame() must follow before the first ray.
  explicit Tracer(const Scene& scene);
  ~Tracer();
  Tracer(const Tracer&) = delete;
  Tracer& operator=(const Tracer&) = delete;

  /// Places the same objects as they stand in `scene`.
  void set_frame(const Scene& scene);
  const Placement& placement(std::size_t object) const { return placements_[object]; }

  /// First hit of every ray. `hits` has the size of `rays`. Safe to call from many threads.
  void intersect(std::span<const Ray> rays, std::span<RayHit> hits) const;
  /// Whether anything lies within every ray's interval.
  void occluded(std::span<const Ray> rays, std::span<std::uint8_t> blocked) const;

 private:
  struct Embree;
  std::vector<std::shared_ptr<const Surface>> surfaces_;  ///< Embree points into them
  std::unique_ptr<Embree> embree_;
  std::vector<Placement> placements_;
};

}  // namespace redmap
