#include "analysis/hidden_frames.h"

#include <algorithm>
#include <cmath>

#include "analysis/grain.h"
#include "analysis/shading_normal.h"
#include "shader/shading_frames.h"

namespace redmap {
namespace {

/// A normal that is found is right to .01 rad (shading_normal.h); so many must lean over farther than that.
constexpr float kLeastTilt = 0.01f;
constexpr int kFewestTilted = 2;
/// Grains that differ by less, as the sine of the angle, are one: two degrees.
constexpr float kLeastTurn = 0.035f;

constexpr Frame kOwn{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

Frame turned(const Frame& frame, Vec2 turn) {
  return {frame.x * turn.x + frame.y * turn.y, frame.y * turn.x - frame.x * turn.y, frame.z};
}

bool are_tilted(const ShadingNormals& normals) {
  int tilted = 0;
  for (std::size_t i = 0; i < normals.found.size(); ++i) {
    const Vec3 n = normals.normal.get(i);
    tilted += normals.found[i] && std::hypot(n.x, n.y) > kLeastTilt;
  }
  return tilted >= kFewestTilted;
}

/// Whether grains that were found differ from each other. Those of isotropic places say nothing.
bool differ(const std::vector<Grain>& grains) {
  const auto first = std::ranges::find(grains, true, &Grain::found);
  return std::any_of(first, grains.end(), [&](const Grain& g) {
    const float sine = first->turn.x * g.turn.y - first->turn.y * g.turn.x;
    return g.found && std::abs(sine) > kLeastTurn;
  });
}

/// Frames about the normals found, with the x of the shader's own.
std::vector<Frame> frames_about(const ShadingNormals& normals) {
  std::vector<Frame> frames(normals.found.size());
  for (std::size_t i = 0; i < frames.size(); ++i)
    frames[i] = normals.found[i] ? make_frame(normals.normal.get(i), {1, 0, 0}) : kOwn;
  return frames;
}

ShaderInfo revealed(ShaderInfo info, HiddenFrames hidden) {
  info.perturbs_normals |= hidden.normals, info.turns_tangents |= hidden.tangents;
  return info;
}

}  // namespace

HiddenFrames find_hidden_frames(const Shader& shader, const SurfacePoints& points) {
  HiddenFrames hidden;
  std::unique_ptr<BoundPatterns> patterns = shader.bind(points);
  if (!shader.info().perturbs_normals) {
    const ShadingNormals normals = estimate_shading_normals(*patterns);
    hidden.normals = are_tilted(normals);
    if (hidden.normals) patterns = in_frames(std::move(patterns), frames_about(normals));
  }
  if (!shader.info().turns_tangents) hidden.tangents = differ(estimate_grain(*patterns));
  return hidden;
}

RevealedShader::RevealedShader(const Shader& shader, HiddenFrames hidden)
    : shader_(shader), hidden_(hidden), info_(revealed(shader.info(), hidden)) {}

std::vector<Frame> RevealedShader::frames(const SurfacePoints& points, const BoundPatterns& patterns) const {
  std::vector<Frame> frames(points.size(), kOwn);
  if (hidden_.normals) {
    const ShadingNormals normals = estimate_shading_normals(patterns);
    places_ += points.size();
    not_found_ += std::ranges::count(normals.found, 0);
    frames = frames_about(normals);
  }
  if (!hidden_.tangents) return frames;
  const std::vector<Grain> grains = estimate_grain(*in_frames(shader_.bind(points), frames));
  for (std::size_t i = 0; i < frames.size(); ++i) frames[i] = turned(frames[i], grains[i].turn);
  return frames;
}

std::vector<Frame> RevealedShader::frames(const SurfacePoints& points) const {
  return frames(points, *shader_.bind(points));
}

std::unique_ptr<BoundPatterns> RevealedShader::bind(const SurfacePoints& points) const {
  std::unique_ptr<BoundPatterns> patterns = shader_.bind(points);
  std::vector<Frame> found = frames(points, *patterns);
  Planes<3> normals, tangents;
  if (!patterns->shading_normals(normals)) normals = points.normal;
  if (!patterns->shading_tangents(tangents)) tangents = points.tangent;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Frame own = make_frame(normals.get(i), tangents.get(i));
    normals.set(i, own.to_world(found[i].z)), tangents.set(i, own.to_world(found[i].x));
  }
  if (!info_.perturbs_normals) normals = {};
  if (!info_.turns_tangents) tangents = {};
  return in_frames(std::move(patterns), std::move(found), std::move(normals), std::move(tangents));
}

}  // namespace redmap
