#version 450
#extension GL_GOOGLE_include_directive : require
// glslangValidator -V -IFOLDER vulkan.frag -o vulkan.frag.spv, FOLDER being that of the export
#include "redmap.glsl"
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 tangent;
layout(location = 3) in vec2 uv;
layout(location = 4) flat in uint triangle;
layout(push_constant) uniform Push { float eye; };
layout(location = 0) out vec4 color;
void main() {
  RedmapHit hit = redmap_seen(position, normal, tangent, uv, normalize(vec3(0.0, 0.0, eye) - position), triangle);
  color = vec4(redmap_shade(hit, normalize(vec3(0.4, 0.5, 0.7)), vec3(3.0)), 1.0);
}
