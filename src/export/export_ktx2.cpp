// Textures of a map as KTX 2.0: the averaged material, and masks as one array texture.
#include "export/export.h"
#include "export/ktx2.h"
#include "export/manifest.h"

namespace redmap {

namespace {

std::string add(const Texture& texture, ExportFolder& folder) {
  const std::string file = texture.name + ".ktx2";
  folder.add(file, ktx2_bytes(texture));
  return file;
}

}  // namespace

void export_ktx2(const ExportInput& input, ExportFolder& folder) {
  Json manifest = manifest_of(input, "ktx2");
  add_one_material(
      input, [&](const Texture& texture) { return add(texture, folder); }, manifest);

  const Masks masks = mask_textures(*input.map);
  std::vector<const Texture*> layers;
  for (const Texture& mask : masks.textures) layers.push_back(&mask);
  const std::string file = add(stack_layers("masks", layers), folder);
  manifest["masks"] = masks_json(masks, [&](std::size_t b, Json& mask) { mask["file"] = file, mask["layer"] = b; });
  add_manifest(manifest, folder);
}

}  // namespace redmap
