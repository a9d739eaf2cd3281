#include "shader/shading_frames.h"

#include <algorithm>
#include <cmath>

namespace redmap {
namespace {

class FramedPatterns final : public BoundPatterns {
 public:
  FramedPatterns(std::unique_ptr<BoundPatterns> patterns, std::vector<Frame> frames, Planes<3> normals,
                 Planes<3> tangents)
      : patterns_(std::move(patterns)),
        frames_(std::move(frames)),
        normals_(std::move(normals)),
        tangents_(std::move(tangents)) {}

  std::size_t size() const override { return frames_.size(); }
  void radiance_each(const DirectionPairs& pairs, Planes<3>& out) const override {
    patterns_->radiance_each(turned(pairs, [&](std::size_t i) -> const Frame& { return frames_[i]; }), out);
  }
  void radiance_one(std::size_t pattern, const DirectionPairs& pairs, Planes<3>& out) const override {
    patterns_->radiance_one(pattern, turned(pairs, [&](std::size_t) -> const Frame& { return frames_[pattern]; }), out);
  }
  void radiance_all(const DirectionPairs& pairs, LaneVector<float>& out) const override {
    const std::size_t stride = padded(size());
    out.resize(pairs.size() * 3 * stride);
    DirectionPairs each;
    each.resize(size());
    Planes<3> radiance;
    for (std::size_t pair = 0; pair < pairs.size(); ++pair) {
      const Vec3 to_light = pairs.to_light.get(pair), to_viewer = pairs.to_viewer.get(pair);
      for (std::size_t i = 0; i < stride; ++i) {
        const Frame& frame = frames_[std::min(i, size() - 1)];
        each.to_light.set(i, frame.to_world(to_light)), each.to_viewer.set(i, frame.to_world(to_viewer));
      }
      patterns_->radiance_each(each, radiance);
      for (int c = 0; c < 3; ++c) std::copy_n(radiance[c], size(), out.data() + (3 * pair + c) * stride);
    }
  }
  void transmittance(Planes<3>& out) const override { patterns_->transmittance(out); }
  void emission(Planes<3>& out) const override { patterns_->emission(out); }
  bool materials(Materials& out) const override { return patterns_->materials(out); }
  bool shading_normals(Planes<3>& out) const override { return give(normals_, out); }
  bool shading_tangents(Planes<3>& out) const override { return give(tangents_, out); }

 private:
  static bool give(const Planes<3>& from, Planes<3>& out) {
    if (from.size() == 0) return false;
    out = from;
    return true;
  }
  template <typename FrameOf>
  static DirectionPairs turned(const DirectionPairs& pairs, const FrameOf& frame_of) {
    DirectionPairs result;
    result.resize(pairs.size());
    for (std::size_t i = 0; i < pairs.to_light.stride(); ++i) {
      const Frame& frame = frame_of(std::min(i, pairs.size() - 1));
      result.to_light.set(i, frame.to_world(pairs.to_light.get(i)));
      result.to_viewer.set(i, frame.to_world(pairs.to_viewer.get(i)));
    }
    return result;
  }

  std::unique_ptr<BoundPatterns> patterns_;
  std::vector<Frame> frames_;
  Planes<3> normals_, tangents_;
};

}  // namespace

Vec2 tangent_turn(Vec3 normal, Vec3 place_tangent, Vec3 shading_tangent) {
  const Frame frame = make_frame(normal, place_tangent);
  const Vec2 turn{dot(shading_tangent, frame.x), dot(shading_tangent, frame.y)};
  const float size = length(turn);
  return size > 1e-6f ? turn * (1 / size) : Vec2{1, 0};
}

std::unique_ptr<BoundPatterns> in_frames(std::unique_ptr<BoundPatterns> patterns, std::vector<Frame> frames,
                                         Planes<3> normals, Planes<3> tangents) {
  return std::make_unique<FramedPatterns>(std::move(patterns), std::move(frames), std::move(normals),
                                          std::move(tangents));
}

std::unique_ptr<BoundPatterns> bind_in_frames(const Shader& shader, const SurfacePoints& points,
                                              std::vector<Frame> frames) {
  std::unique_ptr<BoundPatterns> patterns = shader.bind(points);
  return frames.empty() ? std::move(patterns) : in_frames(std::move(patterns), std::move(frames));
}

}  // namespace redmap
