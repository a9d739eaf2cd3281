// Where the renderer's own kernels find what the texts after this one read; exports bring their own (src/export).
layout(local_size_x = 64) in;
layout(constant_id = 0) const uint redmap_stage = 0u;
const uint redmap_bind_stage = 0u, redmap_near_stage = 1u, redmap_far_stage = 2u, redmap_spread_stage = 3u;
const uint redmap_pass_stage = 4u, redmap_mix_stage = 5u;

layout(std430, binding = 7) readonly buffer RedmapData { uint redmap_data[]; };
uint redmap_word(uint i) { return redmap_data[i]; }
layout(binding = 11) uniform sampler2DArray redmap_texels;

// Uniform in [0, 1), for a sample of the frame (PCG; Jarzynski and Olano 2020).
float redmap_random(uint sample_index) {
  uint first_sample = redmap_first_row * redmap_picture.x;
  uint state = (first_sample + sample_index + redmap_picture.w * 0x9E3779B9u) * 747796405u + 2891336453u;
  uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
  return float(((word >> 22u) ^ word) >> 8u) * (1.0 / 16777216.0);
}

uint redmap_listed(uint list, uint i) {
  uint all = redmap_picture.x * redmap_rows;
  return redmap_samples[list == redmap_near ? i : (list == redmap_far ? all + i : 2u * all - 1u - i)];
}
