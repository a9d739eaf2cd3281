#include "certificate_text.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "map/certificate_json.h"

namespace redmap::cli {

std::string certificate_text(const Certificate& certificate) {
  std::string text = fmt::format("  {:>4} {:>7} {:>8} {:>9}\n", "m", "pixels", "rms",
                                 fmt::format("{:g} %", 100 * certificate.coverage));
  for (const Certificate::Row& row : certificate.rows)
    text += fmt::format("  {:>4g} {:>7} {:>8.4f} {:>9.4f}\n", row.minification, row.pixels, row.rms_error, row.bound);
  const Certificate::Place& worst = certificate.worst;
  text += fmt::format("  worst {:.4f} at uv {:.4f} {:.4f}, position {:.4g} {:.4g} {:.4g}, {:.3g} texels a pixel\n",
                      worst.error, worst.uv.x, worst.uv.y, worst.position.x, worst.position.y, worst.position.z,
                      worst.minification);
  if (!certificate.weakest.empty())
    text += fmt::format("  most of it from {}: {}\n", certificate.weakest, certificate.reason);
  text += fmt::format("  {} quality; truth of {} samples, itself right to {:.4f} rms\n", certificate.quality,
                      certificate.samples, certificate.residual);
  return text;
}

nlohmann::json certificate_json(const Certificate& certificate) { return describe(certificate); }

}  // namespace redmap::cli
