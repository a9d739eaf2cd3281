#include "verify/search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "base/error.h"
#include "surface/map_size.h"

namespace redmap {

namespace {

/// Tolerances that are tried, from the smallest basis to the largest: around the bake's own, in octaves.
constexpr float kTolerances[] = {0.2f, 0.1f, 0.05f, 0.025f, 0.0125f, 0.00625f};
/// Sizes in a row that have to bring the bound down by a tenth, at least, for a larger one to be worth a try. Below
/// kFirstJudged most of a shader is lost in any texel, and bounds say little.
constexpr int kPatience = 2, kFirstJudged = 256;
constexpr double kProgress = 0.9;
/// What tells the pixels of the certificate from those that the search was led by.
constexpr std::uint64_t kFreshSeed = 0x6672657368;

/// A map on trial.
struct Candidate {
  std::shared_ptr<ReductionMap> map;
  BakeReport baked;
  VerifyReport verified;
  double bound = std::numeric_limits<double>::infinity(), flip_bound = bound;
};

/// "an error of 0.05 and a FLIP error of 0.1"; limits of 0 were not asked for.
std::string words_of(double error, double flip, bool asked_error, bool asked_flip) {
  std::string words;
  if (asked_error) words = fmt::format("an error of {:.4g}", error);
  if (asked_flip) words += fmt::format("{}a FLIP error of {:.4g}", asked_error ? " and " : "", flip);
  return words;
}

class Search {
 public:
  Search(const Object& object, const SearchOptions& options, const std::function<void(const SearchStep&)>& step_done)
      : object_(object), options_(options), step_done_(step_done) {
    const auto is_limit = [](double limit) { return limit >= 0 && std::isfinite(limit); };
    if (!is_limit(options.max_error) || !is_limit(options.max_flip) || options.max_error + options.max_flip == 0)
      throw Error("search: max_error, max_flip: expected numbers from 0 up, one of them above it, found {} and {}",
                  options.max_error, options.max_flip);
  }

  SearchResult run() {
    double best = std::numeric_limits<double>::infinity();
    int patience = kPatience;
    for (int size = kSmallestMapSize; size <= options_.bake.size; size *= 2) {
      Candidate candidate = try_size(size);
      if (passes(candidate) && confirm(candidate)) return finish(with_smallest_basis(std::move(candidate)));
      if (size >= kFirstJudged && excess(candidate) > kProgress * best && --patience == 0) break;
      best = std::min(best, excess(candidate));
      last_ = std::move(candidate);
    }
    refuse();
  }

 private:
  Candidate bake_with(int size, float tolerance) {
    Candidate candidate;
    BakeOptions bake_options = options_.bake;
    bake_options.size = size, bake_options.tolerance = tolerance;
    candidate.map =
        std::make_shared<ReductionMap>(bake(*object_.surface, *object_.shader, bake_options, &candidate.baked));
    return candidate;
  }

  void verify_candidate(Candidate& candidate, std::uint64_t seed) {
    VerifyOptions verify_options = options_.verify;
    verify_options.seed ^= seed;
    candidate.verified = verify(object_, candidate.map, verify_options);
    const auto bound = largest_error_bound(candidate.verified.by_minification);
    const auto flip_bound = largest_flip_bound(candidate.verified.by_minification);
    if (bound) candidate.bound = *bound;
    if (flip_bound) candidate.flip_bound = *flip_bound;
    steps_.push_back({candidate.map->size, candidate.map->tolerance, candidate.map->basis.size(),
                      texel_bytes(*candidate.map), candidate.bound, candidate.flip_bound,
                      candidate.verified.certificate.weakest});
    if (step_done_) step_done_(steps_.back());
  }

  /// The largest bound in units of what was asked: of two limits, that which is harder to keep.
  double excess(double bound, double flip_bound) const {
    return std::max(options_.max_error > 0 ? bound / options_.max_error : 0,
                    options_.max_flip > 0 ? flip_bound / options_.max_flip : 0);
  }
  double excess(const Candidate& candidate) const { return excess(candidate.bound, candidate.flip_bound); }
  bool passes(const Candidate& candidate) const { return excess(candidate) <= 1; }
  std::string words_of(double error, double flip) const {
    return redmap::words_of(error, flip, options_.max_error > 0, options_.max_flip > 0);
  }

  /// From the tolerance that the sizes before needed on, as long as the basis is to blame and a larger one helps.
  Candidate try_size(int size) {
    Candidate best;
    for (std::size_t tolerance = tolerance_; tolerance < std::size(kTolerances); ++tolerance) {
      Candidate candidate = bake_with(size, kTolerances[tolerance]);
      if (candidate.map->verdict == MapVerdict::kDoesNotReduce) {
        does_not_reduce_ = candidate.map->verdict_reason;
        break;
      }
      if (best.map && candidate.map->basis.size() == best.map->basis.size()) continue;
      verify_candidate(candidate, 0);
      if (excess(candidate) > kProgress * excess(best)) break;
      best = std::move(candidate), tolerance_ = tolerance;
      if (passes(best) || best.verified.certificate.weakest != "fit") break;
    }
    return best;
  }

  /// Smaller sizes may have asked for a larger basis than `candidate` needs.
  Candidate with_smallest_basis(Candidate candidate) {
    std::size_t tried = 0;
    for (const float tolerance : kTolerances) {
      if (tolerance <= candidate.map->tolerance) break;
      Candidate smaller = bake_with(candidate.map->size, tolerance);
      const std::size_t basis = smaller.map->basis.size();
      if (basis == tried || basis >= candidate.map->basis.size()) continue;
      tried = basis;
      verify_candidate(smaller, 0);
      if (passes(smaller) && confirm(smaller)) return smaller;
    }
    return candidate;
  }

  /// The map that passes was chosen because it does: only pixels that had no part in the choice can say whether it is
  /// so. They become its certificate.
  bool confirm(Candidate& candidate) {
    verify_candidate(candidate, kFreshSeed);
    return passes(candidate);
  }

  SearchResult finish(Candidate candidate) {
    SearchResult result{std::move(*candidate.map), candidate.baked, steps_, {}};
    result.map.certificate = candidate.verified.certificate;
    if (!object_.shader->info().has_material) return result;
    const auto rows = verify_averaged_material(object_, result.map, options_.verify);
    const auto bound = largest_error_bound(rows), flip_bound = largest_flip_bound(rows);
    if (!bound || !flip_bound || excess(*bound, *flip_bound) > 1) return result;
    result.remark = fmt::format("one averaged material is enough: mip-mapped parameters keep {} too",
                                words_of(*bound, *flip_bound));
    if (result.map.verdict == MapVerdict::kReduces)
      result.map.verdict = MapVerdict::kOneMaterial, result.map.verdict_reason = result.remark;
    return result;
  }

  [[noreturn]] void refuse() const {
    if (!last_.map)
      throw Error("object '{}': no map keeps {}: {}", object_.name, words_of(options_.max_error, options_.max_flip),
                  does_not_reduce_.empty() ? "there is no size to try" : does_not_reduce_);
    throw Error("object '{}': no map of up to {} texels keeps {}: at {} it keeps {}, most of it from {}: {}",
                object_.name, options_.bake.size, words_of(options_.max_error, options_.max_flip), last_.map->size,
                words_of(last_.bound, last_.flip_bound), last_.verified.certificate.weakest,
                last_.verified.certificate.reason);
  }

  const Object& object_;
  const SearchOptions& options_;
  const std::function<void(const SearchStep&)>& step_done_;
  std::size_t tolerance_ = 0;  ///< index into kTolerances
  std::vector<SearchStep> steps_;
  Candidate last_;
  std::string does_not_reduce_;
};

}  // namespace

SearchResult search_smallest_map(const Object& object, const SearchOptions& options,
                                 const std::function<void(const SearchStep&)>& step_done) {
  return Search(object, options, step_done).run();
}

}  // namespace redmap
