// Where an object stands in the world, and what its map is like. One buffer an object.
layout(std430, binding = 1) readonly buffer RedmapObject {
  vec4 redmap_axis_x;     // where the object's x points in the world; w: translation's x
  vec4 redmap_axis_y;
  vec4 redmap_axis_z;
  vec4 redmap_shape;      // scale; radius; height; length of dp_du where a mesh's uv has no shape
  uvec4 redmap_numbers;   // the first of its numbers in the picture of numbers, and how many; basis reflectances; the object
  vec4 redmap_map;        // columns, rows, levels; variance of normals from which on four do not say how highlights change
  vec4 redmap_scales[6];  // value of a full byte of each channel
  vec4 redmap_limits;     // how far above the surface rays leave it, in the world
};

vec3 redmap_to_world(vec3 v) {
  return redmap_axis_x.xyz * v.x + redmap_axis_y.xyz * v.y + redmap_axis_z.xyz * v.z;
}
vec3 redmap_to_object(vec3 v) {
  return vec3(dot(v, redmap_axis_x.xyz), dot(v, redmap_axis_y.xyz), dot(v, redmap_axis_z.xyz));
}
vec3 redmap_translation() { return vec3(redmap_axis_x.w, redmap_axis_y.w, redmap_axis_z.w); }
vec3 redmap_point_to_world(vec3 p) { return redmap_to_world(p) * redmap_shape.x + redmap_translation(); }
vec3 redmap_point_to_object(vec3 p) { return redmap_to_object(p - redmap_translation()) / redmap_shape.x; }
