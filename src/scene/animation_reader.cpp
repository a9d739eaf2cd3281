#include "scene/animation_reader.h"

#include <algorithm>
#include <utility>

#include "base/error.h"
#include "scene/frame_spec.h"

namespace redmap {

namespace {

/// What a key may move: how its value is read, and where it goes.
struct Channel {
  enum class Kind { kPlace, kColor, kPositive, kFieldOfView };
  std::string name;
  Kind kind;
  std::function<void(Scene&, Vec3)> apply;
};

std::vector<Channel> camera_channels() {
  using Kind = Channel::Kind;
  return {
      {"camera.position", Kind::kPlace, [](Scene& scene, Vec3 value) { scene.camera.position = value; }},
      {"camera.look_at", Kind::kPlace, [](Scene& scene, Vec3 value) { scene.camera.look_at = value; }},
      {"camera.up", Kind::kPlace, [](Scene& scene, Vec3 value) { scene.camera.up = value; }},
      {"camera.fov", Kind::kFieldOfView, [](Scene& scene, Vec3 value) { scene.camera.vertical_fov_degrees = value.x; }},
      {"background", Kind::kColor, [](Scene& scene, Vec3 value) {
         scene.background = {value.x, value.y, value.z};
       }}};
}

void append_light_channels(const Light& light, std::size_t i, std::vector<Channel>& channels) {
  using Kind = Channel::Kind;
  const std::string prefix = "light." + light.name;
  channels.push_back({prefix + ".intensity", Kind::kColor, [i](Scene& scene, Vec3 value) {
                        scene.lights[i].intensity = {value.x, value.y, value.z};
                      }});
  if (light.type == Light::Type::kPoint)
    channels.push_back(
        {prefix + ".position", Kind::kPlace, [i](Scene& scene, Vec3 value) { scene.lights[i].position = value; }});
  else
    channels.push_back(
        {prefix + ".to_light", Kind::kPlace, [i](Scene& scene, Vec3 value) { scene.lights[i].to_light = value; }});
}

void append_object_channels(const Object& object, std::size_t i, std::vector<Channel>& channels) {
  using Kind = Channel::Kind;
  const std::string prefix = "object." + object.declared_name;
  channels.push_back({prefix + ".translate", Kind::kPlace,
                      [i](Scene& scene, Vec3 value) { scene.objects[i].transform.translate = value; }});
  channels.push_back({prefix + ".rotate", Kind::kPlace,
                      [i](Scene& scene, Vec3 value) { scene.objects[i].transform.rotate_degrees = value; }});
  channels.push_back({prefix + ".scale", Kind::kPositive,
                      [i](Scene& scene, Vec3 value) { scene.objects[i].transform.scale = value.x; }});
}

std::vector<Channel> channels_of(const Scene& scene) {
  std::vector<Channel> channels = camera_channels();
  for (std::size_t i = 0; i < scene.lights.size(); ++i) append_light_channels(scene.lights[i], i, channels);
  for (std::size_t i = 0; i < scene.objects.size(); ++i)
    if (!is_further_tile(scene, i)) append_object_channels(scene.objects[i], i, channels);
  return channels;
}

const Channel& find_channel(const TableReader& key, const std::vector<Channel>& channels) {
  const std::string target = key.text("target");
  const auto found = std::find_if(channels.begin(), channels.end(), [&](const Channel& c) { return c.name == target; });
  if (found != channels.end()) return *found;
  std::vector<std::string> names;
  for (const Channel& channel : channels) names.push_back(channel.name);
  key.complain("target", fmt::format("expected something that moves, as camera.position or object.NAME.rotate, "
                                     "found \"{}\"{}",
                                     target, suggestion(target, names)));
}

Vec3 read_value(const TableReader& key, Channel::Kind kind) {
  switch (kind) {
    case Channel::Kind::kPlace:
      return key.vec3("value");
    case Channel::Kind::kPositive:
      return {key.number("value", kPositive), 0, 0};
    case Channel::Kind::kFieldOfView:
      return {key.number("value", kFieldOfView), 0, 0};
    case Channel::Kind::kColor:
      break;
  }
  const Rgb color = key.rgb("value");
  return {color.r, color.g, color.b};
}

/// Puts the key where it belongs among those of its track.
void insert_key(const TableReader& reader, AnimationKey key, AnimationTrack& track) {
  const auto place = std::lower_bound(track.keys.begin(), track.keys.end(), key.frame,
                                      [](const AnimationKey& other, int frame) { return other.frame < frame; });
  if (place != track.keys.end() && place->frame == key.frame)
    reader.complain("frame",
                    fmt::format("expected one key of {} a frame, found two at frame {}", track.target, key.frame));
  track.keys.insert(place, key);
}

void read_key(const toml::table& table, int index, const std::vector<Channel>& channels, Animation& animation) {
  const TableReader reader(table, fmt::format("animation.key[{}]", index), {"target", "frame", "value"});
  const Channel& channel = find_channel(reader, channels);
  auto track = std::find_if(animation.tracks.begin(), animation.tracks.end(),
                            [&](const AnimationTrack& other) { return other.target == channel.name; });
  if (track == animation.tracks.end())
    track = animation.tracks.insert(track, AnimationTrack{channel.name, {}, channel.apply});
  const int frame = reader.integer("frame", {}, 1, kMaxFrames);
  insert_key(reader, {frame, read_value(reader, channel.kind)}, *track);
}

Turntable read_turntable(const toml::table& table, const Scene& scene) {
  const TableReader reader(table, "animation.turntable", {"object", "degrees_per_frame"});
  const std::string name = reader.text("object");
  const float degrees = reader.number("degrees_per_frame", 1, kAnyNumber);
  std::vector<std::string> names;
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    if (scene.objects[i].declared_name == name) return {i, degrees};
    names.push_back(scene.objects[i].declared_name);
  }
  reader.complain("object",
                  fmt::format("expected an object of the scene, found \"{}\"{}", name, suggestion(name, names)));
}

}  // namespace

Animation read_animation(const toml::table& table, const Scene& scene) {
  const TableReader reader(table, "animation", {"frames", "fps", "key", "turntable"});
  Animation animation;
  animation.frame_count = reader.integer("frames", {}, 1, kMaxFrames);
  animation.frames_per_second = reader.number("fps", 24, kPositive);
  const std::vector<Channel> channels = channels_of(scene);
  int index = 0;
  for (const toml::table* key : reader.tables("key")) read_key(*key, index++, channels, animation);
  if (reader.has("turntable")) animation.turntable = read_turntable(reader.table("turntable"), scene);
  return animation;
}

}  // namespace redmap
