// Shading frames that a shader keeps to itself: found by probing it, and taken out, so that one basis reflectance does
// for all bumps and all grains (paper, section 4.5; docs/shading_normals.md).
#pragma once

#include <atomic>
#include <cstdint>

#include "shader/shader.h"

namespace redmap {

/// What a shader does not say of its shading frames.
struct HiddenFrames {
  bool normals = false;   ///< perturbed, without shading_normal()
  bool tangents = false;  ///< an anisotropic reflectance whose grain turns, without shading_tangent()
  bool any() const { return normals || tangents; }
};

/// Whether `shader` hides either, judged by how it answers at `points`, some hundred places all over a surface.
HiddenFrames find_hidden_frames(const Shader& shader, const SurfacePoints& points);

/// `shader`, which must outlive it, as if it declared what it hides: its patterns are asked in the frames found, and
/// say which these are. Where none is found they keep the shader's own.
class RevealedShader final : public Shader {
 public:
  RevealedShader(const Shader& shader, HiddenFrames hidden);
  const ShaderInfo& info() const override { return info_; }
  const ParameterValues& parameters() const override { return shader_.parameters(); }
  std::unique_ptr<BoundPatterns> bind(const SurfacePoints& points) const override;
  /// The frames found at `points`, each in the frame that the shader is asked in there.
  std::vector<Frame> frames(const SurfacePoints& points) const;

  /// Places that it was bound to, and those of them whose normal was not found.
  struct Tally {
    std::uint64_t places = 0, not_found = 0;
  };
  Tally tally() const { return {places_, not_found_}; }

 private:
  std::vector<Frame> frames(const SurfacePoints& points, const BoundPatterns& patterns) const;

  const Shader& shader_;
  HiddenFrames hidden_;
  ShaderInfo info_;
  mutable std::atomic<std::uint64_t> places_{0}, not_found_{0};
};

}  // namespace redmap
