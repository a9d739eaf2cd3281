// The shading frame of a place, for black boxes.
#ifndef REDMAP_FRAME_GLSL
#define REDMAP_FRAME_GLSL

// Object space to the shading frame: x = tangent, z = normal.
vec3 to_shading_frame(Surface at, vec3 direction) {
  return vec3(dot(direction, at.tangent), dot(direction, cross(at.normal, at.tangent)), dot(direction, at.normal));
}

#endif
