#include "cases.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "quality/bench_scene.h"
#include "scene/placement.h"
#include "surface/mesh.h"

namespace redmap::bench {

namespace {

struct Bump {
  const char* name;
  float kind, slope;
};
// Root mean square slopes: "snow" has .2 along each axis.
constexpr Bump kBumps[] = {{"fbm.08", 0, 0.08f}, {"fbm.25", 0, 0.25f}, {"fbm.5", 0, 0.5f}, {"caps", 1, 0},
                           {"ridges", 2, 0},     {"brick", 3, 0},      {"snow", 4, 0.283f}};

struct Gloss {
  const char* name;
  float gloss, width, diffuse, specular;
};
/// As bright at its peak as the diffuse part.
constexpr Gloss phong(const char* name, float exponent) { return {name, 0, exponent, 0.5f, 1 / (exponent + 2)}; }
constexpr Gloss ggx(const char* name, float roughness) { return {name, 1, roughness, 0.4f, 0.2f}; }
constexpr Gloss kGlosses[] = {phong("phong20", 20), phong("phong100", 100), phong("phong500", 500), ggx("ggx.4", 0.4f),
                              ggx("ggx.2", 0.2f),   ggx("ggx.1", 0.1f),     ggx("ggx.05", 0.05f)};

/// Anisotropic ones, whose grain turns from place to place instead of the normal.
constexpr const char* kGrain = "grain";
struct GrainGloss {
  const char* name;
  float ward, along, across;
};
constexpr GrainGloss kGrainGlosses[] = {{"ward.1x.4", 1, 0.1f, 0.4f}, {"ggx.05x.3", 0, 0.05f, 0.3f}};

/// Texels to the largest bump of fBm, and to a row of bricks; caps and ridges are half as large.
constexpr double kTexelsPerBump = 32;

/// The plane's side, object units: a texel of a 1 024-texel map is about as large as on the unit sphere.
constexpr float kPlaneSide = 3;
/// Between the direction to the viewer and the plane itself.
constexpr float kPlaneDegrees = 40;

template <typename Named, std::size_t N>
std::vector<std::string> names_of(const Named (&all)[N]) {
  std::vector<std::string> names;
  for (const Named& one : all) names.emplace_back(one.name);
  return names;
}

template <typename Named, std::size_t N>
const Named& find_named(const Named (&all)[N], const std::string& name, const char* what) {
  const auto found = std::find_if(std::begin(all), std::end(all), [&](const Named& one) { return name == one.name; });
  if (found == std::end(all))
    throw Error("there is no {} '{}': expected one of {}", what, name, fmt::join(names_of(all), ", "));
  return *found;
}

TriangleMesh make_plane() {
  TriangleMesh mesh;
  for (const float y : {0.0f, 1.0f})
    for (const float x : {0.0f, 1.0f}) {
      mesh.positions.push_back(Vec3{x - 0.5f, y - 0.5f, 0} * kPlaneSide);
      mesh.uv.push_back({x, y});
    }
  mesh.triangles = mesh.uv_triangles = {{0, 1, 3}, {0, 3, 2}};
  mesh.normals = {{0, 0, 1}};
  mesh.normal_triangles = {{0, 0, 0}, {0, 0, 0}};
  return mesh;
}

/// Numbers in [0, 1) that fill it evenly: multiples of an irrational one.
float spread(int i, double step) {
  const double value = i * step;
  return static_cast<float>(value - std::floor(value));
}

Scene make_plane_scene(const std::shared_ptr<const Surface>& surface, const std::shared_ptr<const Shader>& shader,
                       int map_size, double minification, int view, int largest) {
  Scene scene = make_bench_scene(surface, shader, map_size, minification, 0, largest);
  Transform& transform = scene.objects.front().transform;
  transform.rotate_degrees = {kPlaneDegrees - 90, 0, 0};
  transform.translate = {};
  const Placement upright = make_placement(transform);
  // Opposite the viewer: a little aside, 42 degrees over the plane.
  scene.lights.front().position =
      upright.direction_world(normalized(Vec3{0.35f, 0.75f, 0.75f})) * length(scene.lights.front().position);

  // Views look at parts of the plane; where all of it is seen at once, its texels move under the pixels.
  const double pixel = minification / map_size;
  const float room = static_cast<float>(std::max(1 - 1.3 * largest * pixel, 2 * pixel)) * kPlaneSide;
  if (view > 0)
    transform.translate =
        upright.direction_world(Vec3{spread(view, 0.7548777) - 0.5f, spread(view, 0.5698403) - 0.5f, 0} * room);
  place_camera(scene, minification, largest);
  return scene;
}

}  // namespace

std::vector<std::string> bump_names() {
  std::vector<std::string> names = names_of(kBumps);
  names.emplace_back(kGrain);
  return names;
}
std::vector<std::string> gloss_names() {
  std::vector<std::string> names = names_of(kGlosses);
  std::ranges::copy(names_of(kGrainGlosses), std::back_inserter(names));
  return names;
}

bool go_together(const std::string& bump, const std::string& gloss) {
  const bool turns = std::ranges::find(kGrainGlosses, gloss, &GrainGloss::name) != std::end(kGrainGlosses);
  return (bump == kGrain) == turns;
}

std::shared_ptr<const Shader> make_bumpy_shader(const std::string& bump, const std::string& gloss, double texel,
                                                int busy) {
  const float scale = static_cast<float>(1 / (kTexelsPerBump * texel));
  if (bump == kGrain) {
    const GrainGloss& g = find_named(kGrainGlosses, gloss, "gloss of a grain");
    return make_library_shader("brushed_metal",
                               {{"scale", {scale}}, {"ward", {g.ward}}, {"roughness", {g.along, g.across}}});
  }
  const Bump& b = find_named(kBumps, bump, "bump");
  const Gloss& g = find_named(kGlosses, gloss, "gloss");
  return make_library_shader("bumps", {{"kind", {b.kind}},
                                       {"scale", {scale}},
                                       {"slope", {b.slope}},
                                       {"gloss", {g.gloss}},
                                       {"width", {g.width}},
                                       {"diffuse", {g.diffuse}},
                                       {"specular", {g.specular}},
                                       {"busy", {static_cast<float>(busy)}}});
}

bool is_single_basis(const std::string& bump) { return bump != "brick" && bump != "snow"; }

std::shared_ptr<const Surface> make_bumpy_surface(const std::string& object, const std::filesystem::path& models) {
  return object == "plane" ? make_mesh_surface(make_plane()) : make_bench_surface(object, models);
}

double texel_width(const Surface& surface, int map_size) {
  const Extent extent = surface.map_extent(map_size);
  return std::sqrt(surface.area() / (surface.uv_area() * extent.width * extent.height));
}

Scene make_bumpy_scene(const std::string& object, const std::shared_ptr<const Surface>& surface,
                       const std::shared_ptr<const Shader>& shader, int map_size, double minification, int view,
                       int largest) {
  return object == "plane" ? make_plane_scene(surface, shader, map_size, minification, view, largest)
                           : make_bench_scene(surface, shader, map_size, minification, view, largest);
}

}  // namespace redmap::bench
