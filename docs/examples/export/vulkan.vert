#version 450
// glslangValidator -V vulkan.vert -o vulkan.vert.spv
layout(location = 0) in vec3 p;
layout(location = 1) in vec3 n;
layout(location = 2) in vec3 t;
layout(location = 3) in vec2 u;
layout(location = 4) in float f;
layout(push_constant) uniform Push { float eye; };  // on +z, looks at the origin through 40 degrees
layout(location = 0) out vec3 position;
layout(location = 1) out vec3 normal;
layout(location = 2) out vec3 tangent;
layout(location = 3) out vec2 uv;
layout(location = 4) flat out uint triangle;
void main() {
  position = p, normal = n, tangent = t, uv = u, triangle = uint(f);
  gl_Position = vec4(p.xy / tan(radians(20.0)), eye - p.z - 0.2, eye - p.z);
}
