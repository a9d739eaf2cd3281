// Tiled, mip-mapped TIFF for texture systems (OpenImageIO), as `maketx` writes it, except that every level is the map's
// own: averaging an averaged material again would be another material.
#include <OpenImageIO/imageio.h>

#include <fmt/format.h>

#include "base/error.h"
#include "export/export.h"
#include "export/manifest.h"

namespace redmap {

namespace {

constexpr int kTile = 64;  // maketx's default

OIIO::ImageSpec spec_of(const Texture& texture, const Extent& extent) {
  OIIO::ImageSpec spec(extent.width, extent.height, texture.channels, OIIO::TypeDesc::UINT8);
  spec.tile_width = spec.tile_height = kTile;
  spec.tile_depth = 1;
  spec.attribute("textureformat", "Plain Texture");
  spec.attribute("wrapmodes", texture.wraps_u ? "periodic,clamp" : "clamp,clamp");
  spec.attribute("planarconfig", "contig");
  spec.attribute("compression", "zip");
  spec.attribute("oiio:ColorSpace", texture.meaning == TexelMeaning::kColor ? "sRGB" : "Linear");
  spec.attribute("Software", "redmap");
  return spec;
}

/// Means of the channels over the coarsest level, as maketx leaves them for texture systems.
std::string average_color(const Texture& texture) {
  const TextureLevel& last = texture.levels.back();
  std::string text;
  for (int c = 0; c < texture.channels; ++c)
    text += fmt::format("{}{:g}", c ? "," : "", static_cast<float>(*(last.texel(0, 0, texture.channels) + c)) / 255);
  return text;
}

std::string add(const Texture& texture, ExportFolder& folder) {
  const std::string file = texture.name + ".tx", path = folder.path_of(file).string();
  const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create("tif");
  const auto require = [&](bool done) {
    if (!done) throw Error("{}: cannot be written: {}", file, output ? output->geterror() : OIIO::geterror());
  };
  require(output != nullptr);
  for (std::size_t level = 0; level < texture.levels.size(); ++level) {
    OIIO::ImageSpec spec = spec_of(texture, texture.levels[level].extent);
    spec.attribute("oiio:AverageColor", average_color(texture));
    // Texture systems of old find it in the description alone.
    spec.attribute("ImageDescription", fmt::format("oiio:AverageColor={}", average_color(texture)));
    // TIFF knows no levels: subimages of a texture are taken for them.
    require(output->open(path, spec, level == 0 ? OIIO::ImageOutput::Create : OIIO::ImageOutput::AppendSubimage));
    require(output->write_image(OIIO::TypeDesc::UINT8, texture.levels[level].texels.data()));
  }
  require(output->close());
  return file;
}

}  // namespace

void export_tx(const ExportInput& input, ExportFolder& folder) {
  Json manifest = manifest_of(input, "tx");
  add_one_material(
      input, [&](const Texture& texture) { return add(texture, folder); }, manifest);
  const Masks masks = mask_textures(*input.map);
  manifest["masks"] = masks_json(
      masks, [&](std::size_t b, Json& mask) { mask["file"] = add(masks.textures[b], folder), mask["channel"] = 0; });
  add_manifest(manifest, folder);
}

}  // namespace redmap
