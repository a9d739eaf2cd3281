#include "user_shader/stages.h"

#include "base/error.h"
#include "user_shader/device_shader.h"

namespace redmap {
namespace {

/// What does not need the user's types. It comes first, so that no macro of the user's can change it.
constexpr std::string_view kBefore = R"(
layout(local_size_x = 64) in;
layout(constant_id = 0) const uint redmap_stage = 0u;
layout(std430, binding = 1) readonly buffer RedmapIn { float redmap_in[]; };
layout(std430, binding = 3) writeonly buffer RedmapOut { float redmap_out[]; };
layout(std430, binding = 4) buffer RedmapStatus { uint redmap_status; };
layout(push_constant) uniform RedmapCall {
  uint redmap_places;
  uint redmap_pairs;
  uint redmap_pairs_each;
  uint redmap_in_stride;
  uint redmap_pairing;
  float redmap_time;
};

// Every loop of the shader asks before each round.
uint redmap_rounds = 0u;
bool redmap_goes_on() { return ++redmap_rounds <= redmap_most_rounds; }

// After each call of a function of the shader. Says whether the next may follow.
bool redmap_ended(uint redmap_function) {
  if (redmap_rounds <= redmap_most_rounds) return true;
  atomicMin(redmap_status, gl_GlobalInvocationID.x * 8u + redmap_function);
  return false;
}

float redmap_load(uint redmap_row, uint redmap_i) { return redmap_in[redmap_row * redmap_in_stride + redmap_i]; }
vec3 redmap_load3(uint redmap_row, uint redmap_i) {
  return vec3(redmap_load(redmap_row, redmap_i), redmap_load(redmap_row + 1u, redmap_i),
              redmap_load(redmap_row + 2u, redmap_i));
}
void redmap_store(uint redmap_row, uint redmap_i, float redmap_value) {
  redmap_out[redmap_row * redmap_places + redmap_i] = redmap_value;
}
void redmap_store3(uint redmap_row, uint redmap_i, vec3 redmap_value) {
  redmap_store(redmap_row, redmap_i, redmap_value.x);
  redmap_store(redmap_row + 1u, redmap_i, redmap_value.y);
  redmap_store(redmap_row + 2u, redmap_i, redmap_value.z);
}
Surface redmap_place(uint redmap_i) {
  return Surface(redmap_load3(0u, redmap_i), redmap_load3(3u, redmap_i), redmap_load3(6u, redmap_i),
                 vec2(redmap_load(9u, redmap_i), redmap_load(10u, redmap_i)), redmap_time);
}
void redmap_store_material(uint redmap_i, Material redmap_m) {
  redmap_store3(6u, redmap_i, redmap_m.diffuse);
  redmap_store3(9u, redmap_i, redmap_m.specular);
  redmap_store3(12u, redmap_i, redmap_m.transmittance);
  redmap_store(15u, redmap_i, redmap_m.exponent);
  redmap_store(16u, redmap_i, redmap_m.ggx);
  redmap_store(17u, redmap_i, redmap_m.grazing);
  redmap_store3(18u, redmap_i, redmap_m.roughness);
}
)";

/// What does. REDMAP_BOUND is the type of what is bound.
constexpr std::string_view kAfter = R"(
layout(std430, binding = 0) readonly buffer RedmapParameters { Parameters redmap_parameters; };
layout(std430, binding = 2) buffer RedmapPatterns { REDMAP_BOUND redmap_patterns[]; };

void redmap_bind(uint redmap_i) {
  Surface redmap_at = redmap_place(redmap_i);
  vec3 redmap_n = redmap_at.normal;
  vec3 redmap_t = redmap_at.tangent;
#ifdef REDMAP_PERTURBS
  redmap_n = shading_normal(redmap_at, redmap_parameters);
  if (!redmap_ended(1u)) return;
  redmap_store3(0u, redmap_i, redmap_n);
#endif
#ifdef REDMAP_TURNS
  redmap_t = normalize(shading_tangent(redmap_at, redmap_parameters));
  if (!redmap_ended(6u)) return;
  redmap_store3(REDMAP_TURNS, redmap_i, redmap_t);
#endif
#ifndef REDMAP_BLACK_BOX
  redmap_patterns[redmap_i] = pattern(redmap_at, redmap_parameters);
  redmap_ended(0u);
#elif defined(REDMAP_PERTURBS) || defined(REDMAP_TURNS)
  redmap_patterns[redmap_i] = redmap_framed(redmap_at, redmap_n, redmap_t);
#else
  redmap_patterns[redmap_i] = RedmapPlace(redmap_at, redmap_n, redmap_t);
#endif
}

// Some pairs, one after the other: the pattern is read once.
void redmap_radiance(uint redmap_i, uint redmap_first) {
  uint redmap_last = min(redmap_first + redmap_pairs_each, redmap_pairs);
  REDMAP_BOUND redmap_m = redmap_patterns[redmap_pairing == 1u ? 0u : redmap_i];
  for (uint redmap_block = redmap_first; redmap_block < redmap_last; redmap_block++) {
    // Two ways, since a CPU reads what is the same for all neighbours only once.
    vec3 redmap_l, redmap_v;
    if (redmap_pairing == 2u) {
      redmap_l = redmap_load3(0u, redmap_block);
      redmap_v = redmap_load3(3u, redmap_block);
    } else {
      redmap_l = redmap_load3(0u, redmap_i);
      redmap_v = redmap_load3(3u, redmap_i);
    }
#ifdef REDMAP_BLACK_BOX
    vec3 redmap_value = radiance(redmap_m.at, redmap_parameters, redmap_to_object(redmap_m, redmap_l),
                                 redmap_to_object(redmap_m, redmap_v));
#else
    vec3 redmap_value = radiance(redmap_m, redmap_l, redmap_v);
#endif
    if (!redmap_ended(2u)) return;
    redmap_store3(3u * redmap_block, redmap_i, redmap_value);
  }
}

void redmap_constants(uint redmap_i) {
  for (uint redmap_row = 0u; redmap_row < 21u; redmap_row++) redmap_store(redmap_row, redmap_i, 0.0);
#ifdef REDMAP_TRANSMITS
  redmap_store3(0u, redmap_i, transmittance(redmap_patterns[redmap_i]));
  if (!redmap_ended(3u)) return;
#endif
#ifdef REDMAP_EMITS
  redmap_store3(3u, redmap_i, emission(redmap_patterns[redmap_i]));
  if (!redmap_ended(4u)) return;
#endif
#ifdef REDMAP_HAS_MATERIAL
  redmap_store_material(redmap_i, material(redmap_patterns[redmap_i]));
  redmap_ended(5u);
#endif
}

void main() {
  uint redmap_i = gl_GlobalInvocationID.x;
  uint redmap_first = gl_WorkGroupID.y * redmap_pairs_each;
  if (redmap_i >= redmap_places || !redmap_goes_on()) return;
  if (redmap_stage == 0u)
    redmap_bind(redmap_i);
  else if (redmap_stage == 1u)
    redmap_radiance(redmap_i, redmap_first);
  else
    redmap_constants(redmap_i);
}
)";

}  // namespace

std::string_view status_function(std::uint32_t function) {
  constexpr std::string_view kNames[kStatusFunctions] = {
      "pattern", "shading_normal", "radiance", "transmittance", "emission", "material", "shading_tangent", ""};
  return kNames[function % kStatusFunctions];
}

ShaderSources stage_text(const ShaderSources& user, const ShaderInfo& info) {
  ShaderSources all{"", user.names};
  all.names.push_back(user.names.front() + ", as redmap calls it");
  all.text = "#version 450\n" + fmt::format("#line 1 {}\n", all.names.size() - 1) + shader_text_head(info) +
             fmt::format("const uint redmap_most_rounds = {}u;\n", kMostRounds) + std::string(kBefore) +
             shader_text_body(user, info, kStageBuffers) + fmt::format("#line 1 {}\n", all.names.size() - 1) +
             std::string(kAfter);
  return all;
}

}  // namespace redmap
