#include "analysis/shading_normal.h"

#include "analysis/shading_normal_search.h"

namespace redmap {
namespace {

/// Radians around the normal at which gradients are taken: far enough for a cosine to change, near enough to stay above
/// the horizon with normals that are tilted by 40 degrees.
constexpr double kFirstPolar = 0.5, kPolar = 0.45;
/// The paper's 30 calls.
constexpr int kPaperArcSteps = 15;

struct Found {
  std::optional<Vector> normal;
  NormalStage stage;
};

/// From the cheapest to the dearest, until one finds a normal that it can verify.
Found run_cascade(Prober& prober) {
  const Vector& start = prober.geometric_normal();
  if (auto n = normal_by_gradients(prober, start, kFirstPolar, kPolar)) return {n, NormalStage::kGradients};
  if (auto n = normal_by_great_arcs(prober)) return {n, NormalStage::kGreatArcs};
  if (auto n = normal_by_circles(prober, start)) return {n, NormalStage::kCircles};
  if (auto n = normal_by_lobe(prober)) return {n, NormalStage::kLobe};
  return {normal_by_centroid(prober), NormalStage::kCentroid};
}

Found run(Prober& prober, NormalMethod method) {
  switch (method) {
    case NormalMethod::kGreatArc:
      return {normal_by_two_arcs(prober, kPaperArcSteps), NormalStage::kGreatArcs};
    case NormalMethod::kReciprocity:
      return {normal_by_reciprocity(prober), NormalStage::kReciprocity};
    case NormalMethod::kCascade:
      break;
  }
  return run_cascade(prober);
}

const Vector kZ{0, 0, 1};

/// The first step of the cascade for many patterns at once: every question is put to all of them, which is what
/// shaders answer fastest.
class GradientsOfAll {
 public:
  explicit GradientsOfAll(const BoundPatterns& patterns)
      : patterns_(patterns),
        fits_(patterns.size(), GradientFit{kZ}),
        alive_(patterns.size(), 1),
        asked_(patterns.size()),
        answers_(patterns.size()) {
    pairs_.resize(patterns.size());
  }
  void run(ShadingNormals& result) {
    const GradientSteps steps = gradient_steps(kPolar, kFloatPrecision);
    fit(kFirstPolar, steps.first, result), fit(kPolar, steps.second, result);
    ask(result, [&](std::size_t i) { return symmetry_directions(fits_[i].normal, kPolar); });
    for (std::size_t i = 0; i < alive_.size(); ++i) {
      if (!alive_[i] || !is_symmetric(fits_[i], kPolar, answers_[i], kFloatPrecision)) continue;
      const Vector& n = fits_[i].normal;
      result.normal.set(i, Vec3{static_cast<float>(n.x()), static_cast<float>(n.y()), static_cast<float>(n.z())});
      result.found[i] = 1;
    }
  }

 private:
  void fit(double polar, double step, ShadingNormals& result) {
    const auto probe = [&](std::size_t i) { return GradientProbe{fits_[i].normal, polar, step}; };
    ask(result, [&](std::size_t i) { return gradient_directions(probe(i)); });
    for (std::size_t i = 0; i < alive_.size(); ++i) {
      if (!alive_[i]) continue;
      const auto found = fit_gradients(probe(i), answers_[i], kFloatPrecision);
      alive_[i] = found.has_value();
      if (!found) continue;
      fits_[i] = *found;
      if (fits_[i].normal.z() < 0) fits_[i].normal = -fits_[i].normal;
    }
  }
  template <typename DirectionsOf>
  void ask(ShadingNormals& result, const DirectionsOf& directions_of) {
    std::size_t most = 0;
    for (std::size_t i = 0; i < alive_.size(); ++i) {
      asked_[i] = alive_[i] ? directions_of(i) : std::vector<Vector>();
      answers_[i].resize(asked_[i].size());
      result.calls += asked_[i].size(), most = std::max(most, asked_[i].size());
    }
    for (std::size_t q = 0; q < most; ++q) {
      for (std::size_t i = 0; i < pairs_.to_light.stride(); ++i) {
        const std::size_t from = std::min(i, alive_.size() - 1);
        const Vector& d = alive_[from] ? asked_[from][q] : kZ;
        const Vec3 direction{static_cast<float>(d.x()), static_cast<float>(d.y()), static_cast<float>(d.z())};
        pairs_.to_light.set(i, direction), pairs_.to_viewer.set(i, direction);
      }
      patterns_.radiance_each(pairs_, radiance_);
      for (std::size_t i = 0; i < alive_.size(); ++i)
        if (alive_[i]) answers_[i][q] = static_cast<double>(radiance_[0][i]) + radiance_[1][i] + radiance_[2][i];
    }
  }

  const BoundPatterns& patterns_;
  std::vector<GradientFit> fits_;
  std::vector<std::uint8_t> alive_;  ///< not given up
  std::vector<std::vector<Vector>> asked_;
  std::vector<std::vector<double>> answers_;
  DirectionPairs pairs_;
  Planes<3> radiance_;
};

/// Radiance of one pattern. Directions are rounded to floats, and so is what comes back.
class PatternProbe {
 public:
  explicit PatternProbe(const BoundPatterns& patterns) : patterns_(patterns) {}
  void ask(std::size_t pattern, std::span<const DirectionPair> asked, std::span<double> radiance) {
    pairs_.resize(asked.size());
    for (std::size_t i = 0; i < pairs_.to_light.stride(); ++i) {
      const DirectionPair& pair = asked[std::min(i, asked.size() - 1)];  // padding repeats the last
      for (int c = 0; c < 3; ++c) {
        pairs_.to_light[c][i] = static_cast<float>(pair.to_light[c]);
        pairs_.to_viewer[c][i] = static_cast<float>(pair.to_viewer[c]);
      }
    }
    patterns_.radiance_one(pattern, pairs_, out_);
    for (std::size_t i = 0; i < asked.size(); ++i)
      radiance[i] = static_cast<double>(out_[0][i]) + out_[1][i] + out_[2][i];
  }

 private:
  const BoundPatterns& patterns_;
  DirectionPairs pairs_;
  Planes<3> out_;
};

}  // namespace

std::string_view label(NormalMethod method) {
  return method == NormalMethod::kCascade ? "cascade" : method == NormalMethod::kGreatArc ? "great-arc" : "reciprocity";
}

NormalEstimate estimate_shading_normal(const AskRadiance& ask, const Direction& geometric_normal, NormalMethod method,
                                       double precision) {
  Prober prober(ask, to_vector(geometric_normal), precision);
  const Found found = run(prober, method);
  if (!found.normal) return {geometric_normal, false, NormalStage::kNone, prober.calls()};
  return {to_direction(*found.normal), true, found.stage, prober.calls()};
}

ShadingNormals estimate_shading_normals(const BoundPatterns& patterns, NormalMethod method) {
  ShadingNormals result;
  result.normal.resize(patterns.size());
  result.found.resize(patterns.size());
  if (method == NormalMethod::kCascade) GradientsOfAll(patterns).run(result);
  PatternProbe probe(patterns);
  for (std::size_t i = 0; i < patterns.size(); ++i) {
    if (result.found[i]) continue;
    const AskRadiance ask = [&](std::span<const DirectionPair> pairs, std::span<double> radiance) {
      probe.ask(i, pairs, radiance);
    };
    const NormalEstimate estimate = estimate_shading_normal(ask, {0, 0, 1}, method, kFloatPrecision);
    result.normal.set(i, Vec3{static_cast<float>(estimate.normal[0]), static_cast<float>(estimate.normal[1]),
                              static_cast<float>(estimate.normal[2])});
    result.found[i] = estimate.found;
    result.calls += estimate.calls;
  }
  return result;
}

}  // namespace redmap
