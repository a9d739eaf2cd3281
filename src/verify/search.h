// The smallest map that keeps an error, of linear light or of FLIP: baked, verified, and baked again where it fails,
// finer where its texels are to blame and with a larger basis where that is (docs/verify.md).
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bake/bake.h"
#include "verify/verify.h"

namespace redmap {

struct SearchOptions {
  /// That the bounds of all minifications have to keep, of the error and of FLIP; 0: not asked. At least one is.
  double max_error = 0, max_flip = 0;
  BakeOptions bake;  ///< its size and max_basis are the most that is tried; its tolerance is searched for
  VerifyOptions verify;
};

/// A map that was tried.
struct SearchStep {
  int size = 0;
  float tolerance = 0;
  std::size_t basis = 0;
  std::size_t bytes = 0;  ///< that its texels take in memory
  double bound = 0;       ///< of the error, the largest of all minifications
  double flip_bound = 0;  ///< likewise of FLIP
  std::string weakest;    ///< the stage that most of its error comes from
};

struct SearchResult {
  ReductionMap map;  ///< with its certificate, from pixels that no step of the search has seen
  BakeReport report;
  std::vector<SearchStep> steps;
  std::string remark;  ///< one averaged material would do, or nothing
};

/// Searches sizes from kSmallestMapSize up, in powers of two, with tolerances from .2 down to .00625. `step_done` is
/// told about every map that was tried; may be empty. Throws Error where none keeps what was asked, saying what stands
/// in the way, on options out of range, and what bake() and verify() throw. BakeInterrupted where bake.progress says
/// so.
SearchResult search_smallest_map(const Object& object, const SearchOptions& options,
                                 const std::function<void(const SearchStep&)>& step_done = {});

}  // namespace redmap
