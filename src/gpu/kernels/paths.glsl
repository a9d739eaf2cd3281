// What the samples of a band carry where surfaces let light pass: they go on behind what they saw, layer by layer
// (render/wavefront.cpp). Planes of one vector a sample.
layout(std430, binding = 9) buffer RedmapPaths { vec4 redmap_paths[]; };
const uint redmap_through = 0u;      // part of the light from here that arrives at the eye; w: depth of what was seen
const uint redmap_behind = 1u;       // part of the light that passes what is seen now
const uint redmap_receiver = 2u;     // what is seen now, a little above the surface, in the world; w: the sample's width
const uint redmap_first_light = 3u;  // part of each light that passes other surfaces on its way there
uint redmap_path(uint plane, uint sample_index) { return plane * redmap_picture.x * redmap_rows + sample_index; }

uint redmap_here;                      // the sample that is shaded
vec3 redmap_passing = vec3(0.0);       // part of the light that passes what it sees

vec3 redmap_passed(uint light) { return redmap_paths[redmap_path(redmap_first_light + light, redmap_here)].xyz; }
