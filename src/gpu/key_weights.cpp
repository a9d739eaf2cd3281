#include "gpu/key_weights.h"

#include <algorithm>
#include <bit>
#include <unordered_map>

namespace redmap {
namespace {

struct Fit {
  BasisWeights weights{};
  float residual = 0;
};
using Fits = std::unordered_map<std::uint64_t, Fit>;

/// Fits of the keys that are not known, each at the point it was first met at.
Fits fit_unknown(const BakeJob& job, const SampledTexels& sampled, const ChosenBasis& basis, const KnownWeights& known,
                 const PointBatch& batch) {
  Fits fits;
  std::vector<ReflectancePlace> places;
  std::vector<Fit*> fit_of;
  for (std::size_t i = 0; i < batch.points(); ++i) {
    const std::uint64_t key = batch.key(i);
    if ((i > 0 && key == batch.key(i - 1)) || known.of_key.contains(key)) continue;
    const auto [fit, is_new] = fits.try_emplace(key);
    if (is_new) places.push_back(batch.place(i)), fit_of.push_back(&fit->second);
  }
  if (places.empty()) return fits;
  SampledReflectances reflectances;
  sampled.sampler.sample(*job.shader.bind(points_at(places)), reflectances);
  std::vector<float> scaled(reflectances.rows);
  for (std::size_t i = 0; i < places.size(); ++i) {
    scaled_reflectance(reflectances, i, sampled.row_scales, scaled.data());
    fit_of[i]->residual = basis.reflectances.fit(scaled.data(), fit_of[i]->weights);
  }
  return fits;
}

}  // namespace

std::vector<std::uint32_t> weigh_by_keys(const BakeJob& job, const SampledTexels& sampled, const ChosenBasis& basis,
                                         const KnownWeights& known, const PointBatch& batch) {
  const Fits fits = fit_unknown(job, sampled, basis, known, batch);
  const auto fit_of = [&](std::uint64_t key) {
    const auto found = known.of_key.find(key);
    return found == known.of_key.end() ? fits.at(key)
                                       : Fit{known.weights[found->second], known.residuals[found->second]};
  };
  const int size = basis.reflectances.size();
  const std::size_t words = 4 * weight_vectors(size);
  std::vector<std::uint32_t> out(batch.texels().size() * words);
  Fit current;
  for (std::size_t t = 0; t < batch.texels().size(); ++t) {
    BasisWeights sum{};
    float residual = 0, outlier = 0;
    std::size_t outlier_point = batch.first_point(t);
    for (std::size_t i = batch.first_point(t); i < batch.first_point(t) + batch.points_of(t); ++i) {
      if (i == 0 || batch.key(i) != batch.key(i - 1)) current = fit_of(batch.key(i));
      for (int b = 0; b < size; ++b) sum[b] += current.weights[b];
      if (current.residual <= job.options.tolerance)
        residual = std::max(residual, current.residual);
      else if (current.residual > outlier)
        outlier = current.residual, outlier_point = i;
    }
    std::uint32_t* to = &out[t * words];
    to[kResidualWord] = std::bit_cast<std::uint32_t>(residual),
    to[kOutlierWord] = std::bit_cast<std::uint32_t>(outlier);
    to[kOutlierPointWord] = static_cast<std::uint32_t>(outlier_point);
    for (int b = 0; b < size; ++b)
      to[kFirstWeight + b] = std::bit_cast<std::uint32_t>(sum[b] / static_cast<float>(batch.points_of(t)));
  }
  return out;
}

}  // namespace redmap
