#include "gpu/bake_text.h"

#include <fmt/format.h>

#include "gpu/kernel_texts.h"
#include "gpu/nnls_text.h"
#include "user_shader/stages.h"

namespace redmap {
namespace {

/// What does not need the shader's types. It comes first, so that no macro of the shader's can change it.
constexpr std::string_view kBefore = R"(
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer RedmapPlaces { vec4 redmap_places[]; };
layout(std430, binding = 1) readonly buffer RedmapKnown { uvec4 redmap_known[]; };
layout(std430, binding = 2) readonly buffer RedmapFirst { uint redmap_first[]; };
layout(std430, binding = 3) writeonly buffer RedmapOut { redmap_out_type redmap_out[]; };
layout(std430, binding = 4) buffer RedmapStatus { uint redmap_status; };
layout(push_constant) uniform RedmapCall {
  uint redmap_count;
  uint redmap_known_slots;
  float redmap_tolerance;
  float redmap_time;
};

// Every loop asks before each round; calls of the shader start from zero.
uint redmap_rounds = 0u;
bool redmap_goes_on() { return ++redmap_rounds <= redmap_most_rounds; }
bool redmap_ended() { return redmap_rounds <= redmap_most_rounds; }

Surface redmap_place(uint redmap_i) {
  vec4 redmap_a = redmap_places[3u * redmap_i], redmap_b = redmap_places[3u * redmap_i + 1u];
  return Surface(redmap_a.xyz, redmap_b.xyz, redmap_places[3u * redmap_i + 2u].xyz, vec2(redmap_a.w, redmap_b.w),
                 redmap_time);
}

// 64-bit numbers as low and high word.
uvec2 redmap_times(uvec2 redmap_a, uvec2 redmap_b) {
  uint redmap_low, redmap_high;
  umulExtended(redmap_a.x, redmap_b.x, redmap_high, redmap_low);
  return uvec2(redmap_low, redmap_high + redmap_a.x * redmap_b.y + redmap_a.y * redmap_b.x);
}
uvec2 redmap_mixed(uvec2 redmap_x, int redmap_bits) {
  return redmap_x ^ uvec2(redmap_x.x >> redmap_bits | redmap_x.y << (32 - redmap_bits), redmap_x.y >> redmap_bits);
}
// hash64() of base/random.h.
uvec2 redmap_hash(uvec2 redmap_x) {
  uint redmap_carry;
  redmap_x.x = uaddCarry(redmap_x.x, 0x7F4A7C15u, redmap_carry);
  redmap_x.y += 0x9E3779B9u + redmap_carry;
  redmap_x = redmap_times(redmap_mixed(redmap_x, 30), uvec2(0x1CE4E5B9u, 0xBF58476Du));
  redmap_x = redmap_times(redmap_mixed(redmap_x, 27), uvec2(0x133111EBu, 0x94D049BBu));
  return redmap_mixed(redmap_x, 31);
}
// The nearest whole number. Beyond 2^31 floats are whole, and their low words exact.
uvec2 redmap_whole(float redmap_x) {
  if (abs(redmap_x) < 2147483648.0) {
    int redmap_i = int(roundEven(redmap_x));
    return uvec2(uint(redmap_i), uint(redmap_i >> 31));
  }
  float redmap_high = floor(redmap_x * (1.0 / 4294967296.0));
  return uvec2(uint(redmap_x - redmap_high * 4294967296.0), uint(int(redmap_high)));
}
uvec2 redmap_hashed(uvec2 redmap_key, float redmap_sum) {
  return redmap_hash(redmap_hash(redmap_key) ^ redmap_whole(redmap_sum));
}
uvec2 redmap_key_of(vec3 redmap_first_sums, vec3 redmap_last_sums) {
  uvec2 redmap_k = redmap_hashed(uvec2(0u), redmap_first_sums.x);
  redmap_k = redmap_hashed(redmap_k, redmap_first_sums.y);
  redmap_k = redmap_hashed(redmap_k, redmap_first_sums.z);
  redmap_k = redmap_hashed(redmap_k, redmap_last_sums.x);
  redmap_k = redmap_hashed(redmap_k, redmap_last_sums.y);
  return redmap_hashed(redmap_k, redmap_last_sums.z);
}

// What keys are made of: six sums of a reflectance, and what shows that its numbers are sound.
struct RedmapSums {
  vec3 first;
  vec3 last;
  float largest;
  bool fine;
};
// A radiance, with the factors of red, green and blue. Afterwards the next function may be called.
void redmap_add(vec3 redmap_v, vec3 redmap_r0, vec3 redmap_r1, vec3 redmap_g0, vec3 redmap_g1, vec3 redmap_b0,
                vec3 redmap_b1, inout RedmapSums redmap_s) {
  redmap_s.first = fma(redmap_r0, vec3(redmap_v.x), redmap_s.first);
  redmap_s.last = fma(redmap_r1, vec3(redmap_v.x), redmap_s.last);
  redmap_s.first = fma(redmap_g0, vec3(redmap_v.y), redmap_s.first);
  redmap_s.last = fma(redmap_g1, vec3(redmap_v.y), redmap_s.last);
  redmap_s.first = fma(redmap_b0, vec3(redmap_v.z), redmap_s.first);
  redmap_s.last = fma(redmap_b1, vec3(redmap_v.z), redmap_s.last);
  redmap_s.largest = max(redmap_s.largest, max(abs(redmap_v.x), max(abs(redmap_v.y), abs(redmap_v.z))));
  redmap_s.fine = redmap_s.fine && redmap_ended();
  redmap_rounds = 0u;
}
// kUnsoundValue of analysis/sampling.h. No comparison sees that a number is none, but sums pass it on.
bool redmap_sound(RedmapSums redmap_s) {
  uint redmap_bits = floatBitsToUint(redmap_s.first.x + redmap_s.first.y + redmap_s.first.z) & 0x7FFFFFFFu;
  return redmap_s.fine && redmap_bits < 0x7F800000u && redmap_s.largest < 1152921504606846976.0;
}
)";

/// What does.
constexpr std::string_view kCalls = R"(
layout(binding = redmap_parameters_binding) uniform RedmapParameters { Parameters redmap_parameters; };

vec3 redmap_radiance(REDMAP_BOUND redmap_m, vec3 redmap_l, vec3 redmap_v) {
#ifdef REDMAP_BLACK_BOX
  return radiance(redmap_m.at, redmap_parameters, redmap_to_object(redmap_m, redmap_l),
                  redmap_to_object(redmap_m, redmap_v));
#else
  return radiance(redmap_m, redmap_l, redmap_v);
#endif
}
)";

/// Between them stand all samples.
constexpr std::string_view kKeyBegin = R"(
void main() {
  uint redmap_i = gl_GlobalInvocationID.x;
  if (redmap_i >= redmap_count || !redmap_goes_on()) return;
  redmap_rounds = 0u;
  REDMAP_BOUND redmap_m = redmap_bound(redmap_place(redmap_i));
  RedmapSums redmap_s = RedmapSums(vec3(0.0), vec3(0.0), 0.0, redmap_ended());
  redmap_rounds = 0u;
)";
constexpr std::string_view kKeyEnd = R"(
  if (!redmap_sound(redmap_s)) atomicMin(redmap_status, redmap_i);
  redmap_out[redmap_i] = redmap_key_of(redmap_s.first, redmap_s.last);
}
)";

/// $K: the size of the basis. Lines with $ stand for one of each basis reflectance (for_each_of_basis()).
constexpr std::string_view kWeightBegin = R"(
// Where what is known of the key begins, or 0.
uint redmap_find(uvec2 redmap_k) {
  uint redmap_slot = redmap_k.x & (redmap_known_slots - 1u);
  for (uint redmap_probe = 0u; redmap_probe < redmap_known_slots; redmap_probe++) {
    uvec4 redmap_found = redmap_known[redmap_slot];
    if (redmap_found.z == 0u) return 0u;
    if (redmap_found.xy == redmap_k) return redmap_known_slots + (redmap_found.z - 1u) * redmap_weight_vectors;
    redmap_slot = (redmap_slot + 1u) & (redmap_known_slots - 1u);
  }
  return 0u;
}

// `redmap_sum` and the product of two vectors.
redmap_real redmap_add_product(redmap_real3 redmap_a, redmap_real3 redmap_b, redmap_real redmap_sum) {
  return fma(redmap_a.x, redmap_b.x, fma(redmap_a.y, redmap_b.y, fma(redmap_a.z, redmap_b.z, redmap_sum)));
}

void main() {
  uint redmap_texel = gl_GlobalInvocationID.x;
  if (redmap_texel >= redmap_count || !redmap_goes_on()) return;
  float redmap_sum$ = 0.0;
  float redmap_weight$ = 0.0;
  float redmap_residual = 0.0, redmap_largest_residual = 0.0, redmap_outlier = 0.0;
  uint redmap_begin = redmap_first[redmap_texel], redmap_end = redmap_first[redmap_texel + 1u];
  uint redmap_outlier_point = redmap_begin;
  uvec2 redmap_last_key = uvec2(0u);
  for (uint redmap_i = redmap_begin; redmap_i < redmap_end; redmap_i++) {
    redmap_rounds = 0u;
    REDMAP_BOUND redmap_m = redmap_bound(redmap_place(redmap_i));
    RedmapSums redmap_s = RedmapSums(vec3(0.0), vec3(0.0), 0.0, redmap_ended());
    redmap_rounds = 0u;
    RedmapProducts redmap_p;
    redmap_p.own = redmap_real(0.0);
    redmap_p.of$ = redmap_real(0.0);
    vec3 redmap_v;
    redmap_real3 redmap_t;
)";
constexpr std::string_view kWeightEnd = R"(
    if (!redmap_sound(redmap_s)) atomicMin(redmap_status, redmap_i);
    uvec2 redmap_k = redmap_key_of(redmap_s.first, redmap_s.last);
    if (redmap_i == redmap_begin || redmap_k != redmap_last_key) {
      redmap_last_key = redmap_k;
      uint redmap_at = redmap_find(redmap_k);
      if (redmap_at != 0u) {
        redmap_residual = uintBitsToFloat(redmap_known[redmap_at].x);
        redmap_weight$ = uintBitsToFloat(redmap_known[redmap_at + 1u + $ / 4u][$ % 4u]);
      } else {
        RedmapWeights redmap_w = redmap_solve(redmap_p);
        redmap_weight$ = float(redmap_w.of$);
        redmap_residual = float(sqrt(max(redmap_residual_square(redmap_p, redmap_w), redmap_real(0.0)) / redmap_real(redmap_rows)));
      }
    }
    redmap_sum$ += redmap_weight$;
    if (redmap_residual <= redmap_tolerance) {
      redmap_largest_residual = max(redmap_largest_residual, redmap_residual);
    } else if (redmap_residual > redmap_outlier) {
      redmap_outlier = redmap_residual;
      redmap_outlier_point = redmap_i;
    }
  }
  float redmap_points = float(redmap_end - redmap_begin);
  redmap_out[redmap_texel * redmap_weight_vectors] = uvec4(floatBitsToUint(redmap_largest_residual), floatBitsToUint(redmap_outlier), redmap_outlier_point, 0u);
)";

/// Enough digits for every float.
std::string literal(Vec3 v) { return fmt::format("vec3({:.9e}, {:.9e}, {:.9e})", v.x, v.y, v.z); }

/// Adds the sampled value to the sums.
std::string add_line(const SampledTexels& sampled, int row, const std::string& value) {
  std::string factors;
  for (int c = 0; c < 3; ++c)
    for (int first = 0; first < ReflectanceKeys::kProjections; first += 3)
      factors += literal({sampled.keys.factor(first, row + c), sampled.keys.factor(first + 1, row + c),
                          sampled.keys.factor(first + 2, row + c)}) +
                 ", ";
  return fmt::format("  redmap_add({}, {}redmap_s);\n", value, factors);
}

/// Calls `add(row, value)` for all samples: the radiance in every direction, what passes straight through, and what the
/// shader emits.
template <typename Add>
void for_each_sample(const SampledTexels& sampled, const ShaderInfo& info, const Add& add) {
  const DirectionPairs& pairs = sampled.sampler.directions();
  const int count = static_cast<int>(pairs.size());
  for (int p = 0; p < count; ++p)
    add(3 * p, fmt::format("redmap_radiance(redmap_m, {}, {})", literal(pairs.to_light.get(p)),
                           literal(pairs.to_viewer.get(p))));
  if (info.transmits) add(3 * count, "transmittance(redmap_m)");
  if (info.emits) add(3 * count + 3, "emission(redmap_m)");
}

/// Weights are stored four at a time.
std::string store_weights(int basis) {
  std::string text;
  for (int v = 0; 4 * v < basis; ++v) {
    text += fmt::format("  redmap_out[redmap_texel * redmap_weight_vectors + {}u] = floatBitsToUint(vec4(", v + 1);
    for (int b = 4 * v; b < 4 * v + 4; ++b)
      text += fmt::format("{}{}", b > 4 * v ? ", " : "", b < basis ? fmt::format("redmap_sum{}", b) : "0.0");
    text += ") / redmap_points);\n";
  }
  return text + "}\n";
}

ShaderSources whole_text(const DeviceShader& shader, const ShaderInfo& info, std::string_view out_type,
                         const std::string& ours) {
  ShaderSources all{"", shader.sources.names};
  all.names.push_back(shader.sources.names.front() + ", as redmap bakes it");
  const std::string line = fmt::format("#line 1 {}\n", all.names.size() - 1);
  all.text = "#version 450\n" + line + shader_text_head(info) + fmt::format("#define redmap_out_type {}\n", out_type) +
             fmt::format("#define redmap_parameters_binding {}\n", kBakeBuffers + info.images.size()) +
             fmt::format("const uint redmap_most_rounds = {}u;\n", kMostRounds) + std::string(kBefore) +
             shader_text_body(shader.sources, info, kBakeBuffers) + line + std::string(kCalls) +
             std::string(kernel_text("bind")) + ours;
  return all;
}

}  // namespace

int weight_vectors(int basis) { return 1 + (basis + 3) / 4; }

ShaderSources key_text(const DeviceShader& shader, const ShaderInfo& info, const SampledTexels& sampled) {
  std::string text(kKeyBegin);
  for_each_sample(sampled, info, [&](int row, const std::string& value) { text += add_line(sampled, row, value); });
  return whole_text(shader, info, "uvec2", text + std::string(kKeyEnd));
}

ShaderSources weight_text(const DeviceShader& shader, const ShaderInfo& info, const SampledTexels& sampled,
                          const ChosenBasis& basis, bool has_doubles) {
  const int size = basis.reflectances.size(), rows = sampled.sampler.rows();
  std::string text = fmt::format("const uint redmap_weight_vectors = {}u;\nconst uint redmap_rows = {}u;\n",
                                 weight_vectors(size), rows);
  text += nnls_text(basis.reflectances, has_doubles) + for_each_of_basis(kWeightBegin, size);
  for_each_sample(sampled, info, [&](int row, const std::string& value) {
    text += fmt::format("  redmap_v = {};\n", value) + add_line(sampled, row, "redmap_v");
    text += fmt::format("  redmap_t = redmap_real3(redmap_v * {});\n",
                        literal({sampled.row_scales[row], sampled.row_scales[row + 1], sampled.row_scales[row + 2]}));
    text += "  redmap_p.own = redmap_add_product(redmap_t, redmap_t, redmap_p.own);\n";
    for (int b = 0; b < size; ++b) {
      const float* vector = &basis.scaled[static_cast<std::size_t>(b) * rows];
      text += fmt::format("  redmap_p.of{0} = redmap_add_product(redmap_t, redmap_real3({1}), redmap_p.of{0});\n", b,
                          literal({vector[row], vector[row + 1], vector[row + 2]}));
    }
  });
  return whole_text(shader, info, "uvec4", text + for_each_of_basis(kWeightEnd, size) + store_weights(size));
}

}  // namespace redmap
