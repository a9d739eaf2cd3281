// From the samples of a band to its pixels.
layout(local_size_x = 64) in;
layout(std430, binding = 1) writeonly buffer Picture { vec4 picture[]; };
layout(binding = 10) uniform usampler2DArray seen;

void main() {
  uint n = redmap_picture.y, columns = redmap_picture.x / n;
  uint pixel = gl_GlobalInvocationID.x;
  if (pixel >= columns * (redmap_rows / n)) return;
  uvec2 corner = n * uvec2(pixel % columns, pixel / columns);
  vec3 sum = vec3(0.0);
  for (uint y = 0u; y < n; y++)
    for (uint x = 0u; x < n; x++) {
      uvec2 place = corner + uvec2(x, y);
      uint i = 3u * (place.y * redmap_picture.x + place.x);
#ifdef REDMAP_LAYERS
      bool sees = true;  // samples have taken the background
#else
      bool sees = texelFetch(seen, ivec3(place, 0), 0).x != 0u;
#endif
      sum += sees ? vec3(redmap_radiance[i], redmap_radiance[i + 1u], redmap_radiance[i + 2u]) : redmap_background.xyz;
    }
  picture[pixel + columns * (redmap_first_row / n)] = vec4(sum / float(n * n), 1.0);
}
