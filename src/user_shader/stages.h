// The compute shader around a user's text: one stage binds patterns, one asks for radiance, one for what does not
// depend on directions. Not part of the public interface.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "shader/shader_text.h"

namespace redmap {

enum class Stage : std::uint32_t {
  kBind,      ///< 11 rows of places in; patterns out, and 3 rows of shading normals for shaders that declare them
  kRadiance,  ///< patterns and 6 rows of directions in; 3 rows a pair out
  kConstants  ///< patterns in; kConstantRows out
};
inline constexpr int kStages = 3;

/// Rows of kConstants: transmittance, emission, then Material in the order of the prelude.
inline constexpr int kConstantRows = 21;

/// Which patterns meet which pairs.
enum class Pairing : std::uint32_t { kEach, kOnePattern, kAll };

/// Push constants.
struct StageCall {
  std::uint32_t places = 0;      ///< values in a row that is written
  std::uint32_t pairs = 1;       ///< for each of them; more than one with Pairing::kAll only
  std::uint32_t pairs_each = 1;  ///< of them by one invocation, one after the other
  std::uint32_t in_stride = 0;
  Pairing pairing = Pairing::kEach;
  float time = 0;
};

/// Storage buffers by binding; the shader's images follow.
enum StageBuffer { kParameterBuffer, kInBuffer, kPatternBuffer, kOutBuffer, kStatusBuffer, kStageBuffers };
inline constexpr std::uint32_t kGroupSize = 64;

/// The status buffer holds the smallest invocation * kStatusFunctions + function whose loops did not end, or kAllEnded.
inline constexpr std::uint32_t kAllEnded = 0xFFFFFFFF;
inline constexpr std::uint32_t kStatusFunctions = 8;
/// GLSL's names of the functions by their number in the status.
std::string_view status_function(std::uint32_t function);

/// A shader that goes round its loops more often than this for one place and pair does not end. llvmpipe leaves loops,
/// in silence, after 65535 rounds of eight neighbouring invocations, each of which may be in another loop: an
/// invocation that stays below this is well below that.
inline constexpr std::uint32_t kMostRounds = 1u << 14;
inline constexpr const char* kLoopGuard = "redmap_goes_on";
inline constexpr const char* kPatternBlock = "RedmapPatterns";

/// The whole text: prelude, the user's, and ours; its name is added to `sources.names`.
ShaderSources stage_text(const ShaderSources& user, const ShaderInfo& info);

}  // namespace redmap
