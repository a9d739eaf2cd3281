#include "gpu/parameter_memory.h"

#include <half.h>

#include "gpu/map_memory.h"

namespace redmap {
namespace {

/// The channels of a texel, multiplied by coverage.
void append(const Pyramid<float>& pyramid, int level, int x, int y, std::vector<half>& channels) {
  const float* texel = &pyramid.row(level, y)[static_cast<std::size_t>(x) * pyramid.texel_stride()];  // coverage first
  for (int c = 0; c < pyramid.channels(); ++c) channels.emplace_back(texel[1 + c] * texel[0]);
}

}  // namespace

void set_parameter_traits(const ObjectData& data, ObjectTraits& traits) {
  traits.channels = data.parameters->channels() + (data.slopes ? data.slopes->channels() : 0);
  traits.first_slope = data.slopes ? data.parameters->channels() : 0;
  traits.has_coverage = !is_covered(*data.parameters);
  traits.wraps_u = data.parameters->wraps_u();
}

void set_parameter_block(const ObjectData& data, ObjectBlock& block) {
  const Extent extent = data.parameters->extent(0);
  constexpr float kNever = 1e30f;  // one kernel does it all
  block.map = {static_cast<float>(extent.width), static_cast<float>(extent.height),
               static_cast<float>(data.parameters->levels()), kNever};
  block.scales.fill({1, 1, 1, 1});
}

LayeredTexture make_parameter_texture(const Device& device, const ObjectData& data) {
  const Pyramid<float>& parameters = *data.parameters;
  ObjectTraits traits;
  set_parameter_traits(data, traits);
  const int layers = (traits.channels + (traits.has_coverage ? 1 : 0) + 3) / 4;
  std::vector<half> texels, channels;
  for (int level = 0; level < parameters.levels(); ++level) {
    const Extent extent = parameters.extent(level);
    const std::size_t first = texels.size(), layer_texels = std::size_t{4} * extent.width * extent.height;
    texels.resize(first + layers * layer_texels, half(0.0f));
    for (int y = 0; y < extent.height; ++y)
      for (int x = 0; x < extent.width; ++x) {
        channels.clear();
        append(parameters, level, x, y, channels);
        if (data.slopes) append(*data.slopes, level, x, y, channels);
        channels.emplace_back(parameters.coverage(level, x, y));
        const std::size_t at = first + 4 * (static_cast<std::size_t>(y) * extent.width + x);
        for (std::size_t c = 0; c < channels.size() && c / 4 < static_cast<std::size_t>(layers); ++c)
          texels[at + c / 4 * layer_texels + c % 4] = channels[c];
      }
  }
  return LayeredTexture(device, TexelKind::kHalves, parameters.extent(0), layers, parameters.levels(),
                        parameters.wraps_u(), std::as_bytes(std::span(texels)));
}

}  // namespace redmap
