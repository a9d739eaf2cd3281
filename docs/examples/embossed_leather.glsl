// Leather whose grain is a normal map that the shader makes: a material with a normal.
struct Parameters {
  float scale;  // 20 [0.1, 200] 1/unit: grains per object unit
  float depth;  // 0.4 [0, 2]: slope of the grain
};

#include "include/bump.glsl"
#include "include/pbr_material_normal.glsl"

PbrMaterial material_at(Surface at, Parameters p) {
  PbrMaterial m = default_material();
  m.base_color = vec3(0.20, 0.08, 0.04);
  vec3 slope = p.depth * noise_gradient(at.position * p.scale);
  m.normal = normalize(vec3(-dot(slope, at.tangent), -dot(slope, cross(at.normal, at.tangent)), 1.0));
  return m;
}
