// A map certifies itself: random pixels of its object, as frames would meet them, are rendered by brute force and
// through the map; what comes of it is a table of errors with bounds that hold as often as they say, the worst place,
// and the assumption that fails (docs/verify.md). This is the easy call; the steps are in measured_pixel.h, stages.h,
// conformal.h and diagnosis.h.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "map/certificate.h"
#include "verify/diagnosis.h"
#include "verify/measured_pixel.h"

namespace redmap {

/// Minifications that a map is verified at if nothing else is asked for, in octaves: from half a texel a pixel, where
/// the shader itself is sampled, to pixels as wide as a 32nd of the map, where few of most objects are left. So maps of
/// all sizes answer for the same distances.
std::vector<float> verified_minifications(const ReductionMap& map);

struct VerifyOptions {
  Quality quality = Quality::kDefault;
  std::vector<float> minifications;  ///< empty: verified_minifications()
  int pixels = 100;                  ///< for each minification
  int spp = 1024;                    ///< samples of the shader itself in every pixel, at least 2
  double coverage = 0.95;            ///< of the bounds, in (0, 1)
  std::uint64_t seed = 0;
  bool stages = true;  ///< whether the error is taken apart
  std::function<void(double part)> progress;
  std::function<bool()> cancelled;
};

/// Errors of some of the pixels.
struct ErrorRow {
  double of = 0;  ///< the minification or the level that they have in common
  std::size_t pixels = 0;
  double rms = 0, mean = 0, residual = 0, flip = 0;  ///< the last two likewise root mean square, and mean
  std::optional<double> bound, flip_bound;  ///< nothing where the pixels are too few for the coverage asked for
};

struct VerifyReport {
  std::vector<MeasuredPixel> pixels;
  ErrorRow all;
  std::vector<ErrorRow> by_minification, by_level;
  StageShares shares{};
  Certificate certificate;
};

/// Verifies `map`, which has to be of `object` (its transform does not count). The same for any number of threads.
/// Throws Error on options out of range, and where no pixel sees the object's interior.
VerifyReport verify(const Object& object, std::shared_ptr<const ReductionMap> map, const VerifyOptions& options = {});

/// The errors that mip-mapped averaged parameters make of the very same pixels, by minification. Throws Error if the
/// shader has no material() to say.
std::vector<ErrorRow> verify_averaged_material(const Object& object, const ReductionMap& map,
                                               const VerifyOptions& options);

/// Largest of the rows' bounds: of the error, or of FLIP. Rows of too few pixels have none, as where the
/// object is hardly wider than a pixel; nothing if no row has one.
std::optional<double> largest_error_bound(const std::vector<ErrorRow>& rows);
std::optional<double> largest_flip_bound(const std::vector<ErrorRow>& rows);

}  // namespace redmap
