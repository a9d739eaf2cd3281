// Triangles of an object, seen by a view.
layout(location = 0) in vec3 position;
layout(std430, binding = 0) readonly buffer Views { RedmapView views[]; };
layout(push_constant) uniform Draw { uint view; };

void main() { gl_Position = redmap_clip(views[view], redmap_point_to_world(position)); }
