// What stays the same over a frame: the camera of the whole picture and the lights.
struct RedmapLight {
  vec4 place;      // position, or with w = 0 the unit vector to the light
  vec4 intensity;  // irradiance at distance 1; w: the view of its first shadow map, or -1
};
layout(std430, binding = 0) readonly buffer RedmapFrame {
  vec4 redmap_eye;         // w: time
  vec4 redmap_top_left;    // as in a view; steps are pixels of the picture
  vec4 redmap_right;
  vec4 redmap_down;
  vec4 redmap_background;
  uvec4 redmap_picture;    // columns of samples; samples a side of a pixel; lights; frame
  RedmapLight redmap_lights[64];
};
layout(push_constant) uniform RedmapBand {
  uvec4 redmap_blocks;  // of 8 x 8 samples: the first column and row, columns, and how many in all
  uint redmap_first_row;  // of samples, of the band
  uint redmap_rows;
  uint redmap_filters;  // 1: by the map where it may be
  uint redmap_draws;    // 1: one basis reflectance a sample, drawn by its weight
};

// Samples of the band, sorted by what is done with them.
const uint redmap_near = 0u;    // the shader itself
const uint redmap_far = 1u;     // looked up
const uint redmap_spread = 2u;  // looked up, and normals turn enough to change highlights
// Set in the number of a sample that is looked up and blended with the shader itself. Decided once: another kernel that
// rounds otherwise would read what nobody wrote.
const uint redmap_in_both = 0x80000000u;
layout(std430, binding = 3) buffer RedmapLists {
  uint redmap_counts[4];       // while sorting; the last: what a shader did wrong
  uvec4 redmap_groups[3];      // workgroups, and w: how many samples
  uint redmap_samples[];       // near ones, then the others: far from the front, spread from the back
};
layout(std430, binding = 4) buffer RedmapRadiance { float redmap_radiance[]; };  // three a sample of the band

uvec2 redmap_place_of(uint sample_index) {
  return uvec2(sample_index % redmap_picture.x, sample_index / redmap_picture.x);
}
