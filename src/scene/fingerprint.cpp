#include "scene/fingerprint.h"

#include <bit>
#include <string_view>

#include "base/hash.h"

namespace redmap {

namespace {

/// Chains hash64 over everything it is given, in order.
class Hasher {
 public:
  void add(std::uint64_t bits) { state_ = hash64(state_, bits); }
  /// -0 counts as 0.
  void add(float value) { add(static_cast<std::uint64_t>(std::bit_cast<std::uint32_t>(value == 0 ? 0.0f : value))); }
  void add(Vec3 v) { add(v.x), add(v.y), add(v.z); }
  void add(Rgb c) { add(c.r), add(c.g), add(c.b); }
  void add(std::string_view text) { state_ = hash_bytes(state_, text.data(), text.size()); }
  std::uint64_t state() const { return state_; }

 private:
  std::uint64_t state_ = 0;
};

void add_camera(Hasher& hasher, const Camera& camera) {
  hasher.add(camera.position), hasher.add(camera.look_at), hasher.add(camera.up);
  hasher.add(camera.vertical_fov_degrees);
  hasher.add(static_cast<std::uint64_t>(camera.width)), hasher.add(static_cast<std::uint64_t>(camera.height));
}

void add_light(Hasher& hasher, const Light& light) {
  const bool is_point = light.type == Light::Type::kPoint;
  hasher.add(static_cast<std::uint64_t>(is_point));
  hasher.add(is_point ? light.position : light.to_light);
  hasher.add(light.intensity);
  hasher.add(static_cast<std::uint64_t>(light.shadows));
}

void add_object(Hasher& hasher, const Object& object, float time_seconds) {
  hasher.add(object.surface->pose_fingerprint());
  hasher.add(object.transform.translate), hasher.add(object.transform.rotate_degrees);
  hasher.add(object.transform.scale);
  const ShaderInfo& info = object.shader->info();
  hasher.add(std::string_view(info.name)), hasher.add(info.text_hash);
  for (const std::vector<float>& values : object.shader->parameters()) {
    hasher.add(static_cast<std::uint64_t>(values.size()));
    for (float value : values) hasher.add(value);
  }
  if (info.varies_in_time) hasher.add(time_seconds);
}

}  // namespace

std::uint64_t scene_fingerprint(const Scene& scene) {
  Hasher hasher;
  add_camera(hasher, scene.camera);
  hasher.add(scene.background);
  hasher.add(static_cast<std::uint64_t>(scene.lights.size()));
  for (const Light& light : scene.lights) add_light(hasher, light);
  hasher.add(static_cast<std::uint64_t>(scene.objects.size()));
  for (const Object& object : scene.objects) add_object(hasher, object, scene.time_seconds);
  return hasher.state();
}

}  // namespace redmap
