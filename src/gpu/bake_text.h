// The compute shaders of a bake on a device: one makes keys of reflectances, one weights. All that a bake knows before
// it runs them stands in their text as numbers, and no loop goes over the directions: compilers fold what is constant,
// and software devices read tables number by number (docs/gpu.md). Not part of the public interface.
#pragma once

#include <cstdint>
#include <string>

#include "bake/project.h"
#include "bake/sample.h"
#include "user_shader/device_shader.h"

namespace redmap {

/// Storage buffers by binding; then come the shader's images, then the uniform buffer of its struct Parameters.
enum BakeBuffer {
  kBakePlaces,  ///< 12 floats a place: position and u, normal and v, tangent
  kBakeKnown,   ///< hash table of known keys: key and index + 1, or zeros; then their residuals and weights
  kBakeFirst,   ///< weights: the first point of every texel, and the end of the last
  kBakeOut,     ///< keys: two words a point. Weights: four words times weight_vectors() a texel
  kBakeStatus,  ///< the first point of which something is wrong, or kNothingWrong
  kBakeBuffers
};

/// Push constants.
struct BakeCall {
  std::uint32_t count = 0;        ///< points (keys) or texels (weights)
  std::uint32_t known_slots = 0;  ///< a power of two
  float tolerance = 0, time = 0;
};

inline constexpr std::uint32_t kNothingWrong = 0xFFFFFFFF;
inline constexpr std::uint32_t kBakeGroup = 64;  ///< invocations of a workgroup

/// What of a texel comes out, four words at a time: largest residual within the tolerance, largest beyond it, the point
/// that has it, and nothing; then the weights.
enum BakeOutWord { kResidualWord, kOutlierWord, kOutlierPointWord, kFirstWeight = 4 };
/// Groups of four words that the weights of a basis take with what comes before them.
int weight_vectors(int basis);

/// Name of the function that guards loops.
inline constexpr const char* kBakeLoopGuard = "redmap_goes_on";

/// An invocation makes the key of a point: ReflectanceKeys, bit by bit but for the rounding of sums. Of `sampled` the
/// sampler, the keys and the scales are used.
ShaderSources key_text(const DeviceShader& shader, const ShaderInfo& info, const SampledTexels& sampled);

/// An invocation averages the weights of the points of a texel. A reflectance whose key is known has the weights known;
/// others are fitted as ReflectanceBasis::fit() does, in 64 bits where the device `has_doubles`.
ShaderSources weight_text(const DeviceShader& shader, const ShaderInfo& info, const SampledTexels& sampled,
                          const ChosenBasis& basis, bool has_doubles);

}  // namespace redmap
