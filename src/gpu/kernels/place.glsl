// What the object's own text is given (compare user_shader/stages.cpp).
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
float redmap_number(uint i) { return uintBitsToFloat(redmap_word(i)); }
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
#ifdef REDMAP_POSED
  return Surface(hit.rest_position, hit.rest_normal, hit.rest_tangent, hit.uv, redmap_eye.w);
#else
  return Surface(hit.position, hit.normal, hit.tangent, hit.uv, redmap_eye.w);
#endif
}

// Directions in the frame whose x is `tangent` and z is `normal`.
vec3 redmap_in_frame(vec3 v, vec3 normal, vec3 tangent) {
  return vec3(dot(v, tangent), dot(v, cross(normal, tangent)), dot(v, normal));
}
