#include "shading_normals/reflectance_models.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace redmap::bench {

namespace {

using Vector = Eigen::Vector3d;
constexpr double kPi = std::numbers::pi;

double light_cosine(const ModelQuery& q) { return q.shading_normal.dot(q.to_light); }
double viewer_cosine(const ModelQuery& q) { return q.shading_normal.dot(q.to_viewer); }
bool above_horizon(const ModelQuery& q) { return light_cosine(q) > 0 && viewer_cosine(q) > 0; }
bool above_geometric_horizon(const ModelQuery& q) {
  return q.geometric_normal.dot(q.to_light) > 0 && q.geometric_normal.dot(q.to_viewer) > 0;
}
Vector half_vector(const ModelQuery& q) { return (q.to_light + q.to_viewer).normalized(); }
double half_cosine(const ModelQuery& q) { return std::max(0.0, q.shading_normal.dot(half_vector(q))); }

double lambert(const ModelQuery& q, double albedo) { return albedo * std::max(0.0, light_cosine(q)); }

/// A lobe of the mirror direction whose radiance has no cosine, as Phong 1975 has it: not reciprocal.
double phong(const ModelQuery& q, double diffuse, double specular, double exponent) {
  const double cosine = light_cosine(q);
  if (cosine <= 0) return 0;
  const Vector mirrored = 2 * cosine * q.shading_normal - q.to_light;
  return diffuse * cosine + specular * std::pow(std::max(0.0, mirrored.dot(q.to_viewer)), exponent);
}

/// Reciprocal: one brdf times the cosine at the light (Blinn 1977).
double blinn(const ModelQuery& q, double diffuse, double specular, double exponent) {
  if (!above_horizon(q)) return 0;
  return light_cosine(q) * (diffuse + specular * std::pow(half_cosine(q), exponent));
}

/// Tangent of the anisotropic models: where the object's x axis falls.
struct Anisotropy {
  Vector x, y;
  explicit Anisotropy(const Vector& n) : x((Vector::UnitX() - n * n.x()).normalized()), y(n.cross(x)) {}
};

/// Walter et al. 2007 with height-correlated shadowing (Heitz 2014), Schlick's Fresnel term, reflectance .2.
double ggx(const ModelQuery& q, double diffuse, double alpha_x, double alpha_y) {
  if (!above_horizon(q)) return 0;
  const Anisotropy frame(q.shading_normal);
  const Vector h = half_vector(q);
  const auto square_slope = [&](const Vector& v) {
    const double x = v.dot(frame.x) * alpha_x, y = v.dot(frame.y) * alpha_y, z = v.dot(q.shading_normal);
    return (x * x + y * y) / (z * z);
  };
  const auto lambda = [&](const Vector& v) { return (std::sqrt(1 + square_slope(v)) - 1) / 2; };
  const double hx = h.dot(frame.x) / alpha_x, hy = h.dot(frame.y) / alpha_y, hz = h.dot(q.shading_normal);
  const double d = hx * hx + hy * hy + hz * hz;
  const double distribution = 1 / (kPi * alpha_x * alpha_y * d * d);
  const double shadowing = 1 / (1 + lambda(q.to_light) + lambda(q.to_viewer));
  const double fresnel = 0.2 + 0.8 * std::pow(1 - std::clamp(h.dot(q.to_light), 0.0, 1.0), 5);
  return diffuse * light_cosine(q) + kPi * distribution * fresnel * shadowing / (4 * viewer_cosine(q));
}

/// Oren and Nayar 1994, the qualitative model.
double oren_nayar(const ModelQuery& q, double sigma) {
  if (!above_horizon(q)) return 0;
  const double s2 = sigma * sigma, a = 1 - 0.5 * s2 / (s2 + 0.33), b = 0.45 * s2 / (s2 + 0.09);
  const double ci = light_cosine(q), co = viewer_cosine(q);
  const double si = std::sqrt(std::max(0.0, 1 - ci * ci)), so = std::sqrt(std::max(0.0, 1 - co * co));
  const double azimuth = si * so > 0 ? (q.to_light.dot(q.to_viewer) - ci * co) / (si * so) : 1;
  return 0.6 * ci * (a + b * std::max(0.0, azimuth) * si * so / std::max(ci, co));
}

/// Ward 1992.
double ward(const ModelQuery& q, double alpha_x, double alpha_y) {
  if (!above_horizon(q)) return 0;
  const Anisotropy frame(q.shading_normal);
  const Vector h = half_vector(q);
  const double hx = h.dot(frame.x) / alpha_x, hy = h.dot(frame.y) / alpha_y, hz = h.dot(q.shading_normal);
  const double exponent = -(hx * hx + hy * hy) / (hz * hz), ci = light_cosine(q), co = viewer_cosine(q);
  return ci * (0.3 + 0.3 / std::sqrt(ci * co) * std::exp(exponent) / (4 * kPi * alpha_x * alpha_y));
}

/// Diffuse under a coat whose reflectance is Schlick's.
double coated(const ModelQuery& q) {
  if (!above_horizon(q)) return 0;
  const double fresnel = 0.04 + 0.96 * std::pow(1 - viewer_cosine(q), 5);
  return (1 - fresnel) * lambert(q, 0.6) + 3 * fresnel * std::pow(half_cosine(q), 80);
}

/// Fibres that light up at grazing views, over a dark base.
double velvet(const ModelQuery& q) {
  const double rim = 1 - std::max(0.0, viewer_cosine(q));
  return lambert(q, 0.1 + 0.6 * rim * rim);
}

double square(double x) { return x * x; }

const ReflectanceModel kModels[] = {
    {"lambert", true, [](const ModelQuery& q) { return lambert(q, 0.6); }},
    {"lambert_phong50", true, [](const ModelQuery& q) { return phong(q, 0.5, 0.5, 50); }},
    {"lambert_phong500", true, [](const ModelQuery& q) { return phong(q, 0.5, 0.5, 500); }},
    {"phong500", false, [](const ModelQuery& q) { return phong(q, 0, 0.8, 500); }},
    {"lambert_ggx", true, [](const ModelQuery& q) { return ggx(q, 0.4, 0.1, 0.1); }},
    {"ggx", true, [](const ModelQuery& q) { return ggx(q, 0, 0.1, 0.1); }},
    {"lambert_blinn60", true, [](const ModelQuery& q) { return blinn(q, 0.5, 2, 60); }},
    {"ambient_phong50", true, [](const ModelQuery& q) { return 0.1 + phong(q, 0.5, 0.5, 50); }},
    {"emission_lambert", true, [](const ModelQuery& q) { return 0.5 + lambert(q, 0.6); }},
    {"half_lambert", true, [](const ModelQuery& q) { return 0.6 * square(0.5 + 0.5 * light_cosine(q)); }},
    {"wrapped_lambert", true, [](const ModelQuery& q) { return 0.6 * std::max(0.0, (light_cosine(q) + 0.3) / 1.3); }},
    {"two_sided_lambert", true, [](const ModelQuery& q) { return 0.6 * std::abs(light_cosine(q)); }},
    {"phong50_cut_at_geometry", true,
     [](const ModelQuery& q) { return above_geometric_horizon(q) ? phong(q, 0.5, 0.5, 50) : 0; }},
    {"phong50_cut_at_both", true,
     [](const ModelQuery& q) { return above_geometric_horizon(q) && above_horizon(q) ? phong(q, 0.5, 0.5, 50) : 0; }},
    {"toon", false, [](const ModelQuery& q) { return light_cosine(q) > 0.3 ? 0.8 : 0.2; }},
    {"toon_on_black", false, [](const ModelQuery& q) { return light_cosine(q) > 0.3 ? 0.8 : 0.0; }},
    {"toon_cut_at_geometry", false,
     [](const ModelQuery& q) { return !above_geometric_horizon(q) ? 0.0
                                      : light_cosine(q) > 0.3     ? 0.8
                                                                  : 0.7; }},
    {"toon_three_bands", false,
     [](const ModelQuery& q) { return 0.1 + 0.3 * (light_cosine(q) > 0.3) + 0.5 * (light_cosine(q) > 0.85); }},
    {"velvet", true, velvet},
    {"oren_nayar", true, [](const ModelQuery& q) { return oren_nayar(q, 0.5); }},
    {"coated", true, coated},
    {"ward_anisotropic", false, [](const ModelQuery& q) { return ward(q, 0.1, 0.4); }},
    {"ggx_anisotropic", false, [](const ModelQuery& q) { return ggx(q, 0.4, 0.05, 0.3); }},
    {"black", false, [](const ModelQuery&) { return 0.0; }},
};

}  // namespace

std::span<const ReflectanceModel> reflectance_models() { return kModels; }

const ReflectanceModel& reflectance_model(std::string_view name) {
  const auto found = std::ranges::find(kModels, name, &ReflectanceModel::name);
  assert(found != std::end(kModels));
  return *found;
}

}  // namespace redmap::bench
