// What the object's own text is given, and the world around it (compare user_shader/stages.cpp).
layout(local_size_x = 64) in;
layout(constant_id = 0) const uint redmap_stage = 0u;
const uint redmap_bind_stage = 0u, redmap_near_stage = 1u, redmap_far_stage = 2u, redmap_spread_stage = 3u;

// Every loop of a user's shader asks before each round; each call starts anew. What does not end is remembered.
#ifdef REDMAP_GUARDED
uint redmap_rounds = 0u;
bool redmap_goes_on() { return ++redmap_rounds <= redmap_most_rounds; }
void redmap_ended(uint function) {
  if (redmap_rounds > redmap_most_rounds) redmap_counts[3] = 1u + 8u * redmap_numbers.w + function;
  redmap_rounds = 0u;
}
#else
void redmap_ended(uint function) {}
#endif
// For loops of ours, which end: they take no rounds.
void redmap_forget_rounds() {
#ifdef REDMAP_GUARDED
  redmap_rounds = 0u;
#endif
}

// Places of the basis, lobe models, normals: floats by their bits, or bytes.
layout(std430, binding = 7) readonly buffer RedmapData { uint redmap_data[]; };
float redmap_number(uint i) { return uintBitsToFloat(redmap_data[i]); }
vec3 redmap_vector(uint i) { return vec3(redmap_number(i), redmap_number(i + 1u), redmap_number(i + 2u)); }

#ifdef REDMAP_HIDES_FRAMES
const uint redmap_place_floats = 18u;
#else
const uint redmap_place_floats = 12u;
#endif
Surface redmap_basis_place(uint b) {
  uint i = b * redmap_place_floats;
  return Surface(redmap_vector(i), redmap_vector(i + 3u), redmap_vector(i + 6u),
                 vec2(redmap_number(i + 9u), redmap_number(i + 10u)), redmap_eye.w);
}
#ifdef REDMAP_HIDES_FRAMES
// From the frame that a basis reflectance is asked in to the shader's own.
vec3 redmap_unhidden(uint b, vec3 v) {
  uint i = b * redmap_place_floats + 12u;
  vec3 x = redmap_vector(i), z = redmap_vector(i + 3u);
  return x * v.x + cross(z, x) * v.y + z * v.z;
}
#endif
Surface redmap_hit_place(RedmapHit hit) {
  return Surface(hit.position, hit.normal, hit.tangent, hit.uv, redmap_eye.w);
}

// Directions in the frame whose x is `tangent` and z is `normal`.
vec3 redmap_in_frame(vec3 v, vec3 normal, vec3 tangent) {
  return vec3(dot(v, tangent), dot(v, cross(normal, tangent)), dot(v, normal));
}

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
