// MaterialX 1.38 (Academy Software Foundation): the fitted surfaces as standard_surface, mixed by masks. A mixture of
// surfaces takes weights that sum to one, so that masks are written as parts of their sum, one mix after the other.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "export/export.h"
#include "export/manifest.h"

namespace redmap {

namespace {

/// "body" of "body.1001", the name of a tile of a mesh; nothing for names of other kinds.
std::optional<std::string> udim_stem(const std::string& name) {
  constexpr std::size_t kSuffix = 5;
  if (name.size() < kSuffix || name.find_last_not_of("0123456789") != name.size() - kSuffix) return std::nullopt;
  const std::string suffix = name.substr(name.size() - kSuffix);
  return suffix.starts_with(".1") ? std::optional(name.substr(0, name.size() - kSuffix)) : std::nullopt;
}

/// "body.1001" becomes "body.<UDIM>": other tiles of the mesh are exported likewise, and one document reads them all.
std::string udim_pattern(const std::string& name) {
  const std::optional<std::string> stem = udim_stem(name);
  return stem ? *stem + ".<UDIM>" : name;
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '&')
      out += "&amp;";
    else
      out.push_back(c);
  }
  return out;
}

std::string input(const char* name, const char* type, const std::string& value) {
  return fmt::format("    <input name=\"{}\" type=\"{}\" value=\"{}\" />\n", name, type, value);
}
std::string node_input(const char* name, const char* type, const std::string& node) {
  return fmt::format("    <input name=\"{}\" type=\"{}\" nodename=\"{}\" />\n", name, type, node);
}
std::string text_of(float value) { return fmt::format("{:.6g}", value); }
std::string text_of(Rgb c) { return fmt::format("{:.6g}, {:.6g}, {:.6g}", c.r, c.g, c.b); }
float largest(Rgb c) { return std::max({c.r, c.g, c.b}); }

std::string image_node(const std::string& name, const char* type, const std::string& file, const char* colorspace) {
  return fmt::format(
      "  <image name=\"{}\" type=\"{}\">\n    <input name=\"file\" type=\"filename\" value=\"{}\"{} />\n  </image>\n",
      name, type, escaped(file), colorspace);
}

/// standard_surface divides and multiplies squared roughness by sqrt(1 - anisotropy), along its rotation and across.
std::string roughness_inputs(const GltfMaterial& m) {
  if (m.anisotropy <= 0) return input("specular_roughness", "float", text_of(m.roughness));
  constexpr float kMostAnisotropic = 0.98f;  // of the node roughness_anisotropy
  const float across = m.roughness * m.roughness, along = across + (1 - across) * m.anisotropy * m.anisotropy;
  return input("specular_roughness", "float", text_of(std::pow(along * across, 0.25f))) +
         input("specular_anisotropy", "float", text_of(std::min(kMostAnisotropic, 1 - across / along))) +
         input("specular_rotation", "float", text_of(m.anisotropy_rotation / (2 * kPi)));
}

/// A fitted material. standard_surface's specular is white over a diffuse part, its metal takes the base colour.
std::string surface_node(const std::string& name, const GltfMaterial& m, bool has_normal) {
  const float reflectance = kGltfReflectance * largest(m.specular_color);
  // The index of refraction with that reflectance at normal incidence.
  const float root = std::sqrt(std::clamp(reflectance, 0.0f, 0.9f)), ior = (1 + root) / (1 - root);
  const Rgb tint = m.specular_color * (1 / std::max(largest(m.specular_color), 1e-6f));
  std::string text = fmt::format("  <standard_surface name=\"{}\" type=\"surfaceshader\">\n", name);
  text += input("base", "float", "1") + input("base_color", "color3", text_of(m.base_color));
  text += input("metalness", "float", text_of(m.metallic)) + input("specular", "float", text_of(m.specular));
  text += input("specular_color", "color3", text_of(tint)) + input("specular_IOR", "float", text_of(ior));
  text += roughness_inputs(m);
  if (m.coat > 0)
    text += input("coat", "float", text_of(m.coat)) + input("coat_roughness", "float", text_of(m.coat_roughness));
  if (m.transmission > 0)
    text += input("transmission", "float", text_of(m.transmission)) +
            input("transmission_color", "color3", text_of(m.base_color)) + input("thin_walled", "boolean", "true");
  if (largest(m.emission) > 0)
    text += input("emission", "float", "1") + input("emission_color", "color3", text_of(m.emission));
  if (has_normal) text += node_input("normal", "vector3", "normal_map");
  return text + "  </standard_surface>\n";
}

/// Parts that each surface takes from what those before it leave: mix i is surface i over mix i - 1 by this mask.
std::vector<Texture> mixing_masks(const Masks& masks) {
  std::vector<Texture> mixing(masks.textures.begin(), masks.textures.end());
  for (std::size_t level = 0; level < mixing.front().levels.size(); ++level)
    for (std::size_t i = 0; i < mixing.front().levels[level].texels.size(); ++i) {
      float sum = 0;
      for (std::size_t b = 0; b < mixing.size(); ++b) {
        const float weight = masks.scales[b] * static_cast<float>(masks.textures[b].levels[level].texels[i]);
        sum += weight;
        mixing[b].levels[level].texels[i] = static_cast<std::uint8_t>(std::lround(255 * (sum > 0 ? weight / sum : 0)));
      }
    }
  return mixing;
}

}  // namespace

void export_mtlx(const ExportInput& in, ExportFolder& folder) {
  const std::string pattern = udim_pattern(in.name);
  const std::vector<Texture> masks = mixing_masks(mask_textures(*in.map));
  const auto normals = normal_textures(*in.map);
  std::string nodes;
  if (normals) {
    folder.add(in.name + ".normal.png", png_bytes(normals->normal));
    nodes += image_node("normal_image", "vector3", pattern + ".normal.png", "");
    nodes += "  <normalmap name=\"normal_map\" type=\"vector3\">\n" + node_input("in", "vector3", "normal_image") +
             "  </normalmap>\n";
  }
  std::string last = "surface00";
  nodes += surface_node(last, in.fits.front().material, normals.has_value());
  Json manifest = manifest_of(in, "mtlx");
  for (std::size_t b = 1; b < in.fits.size(); ++b) {
    const std::string mask = fmt::format("mask{:02}", b), surface = fmt::format("surface{:02}", b);
    folder.add(fmt::format("{}.{}.png", in.name, mask), png_bytes(masks[b]));
    nodes += image_node(mask, "float", fmt::format("{}.{}.png", pattern, mask), "");
    nodes += surface_node(surface, in.fits[b].material, normals.has_value());
    const std::string mix = fmt::format("mix{:02}", b);
    nodes += fmt::format("  <mix name=\"{}\" type=\"surfaceshader\">\n", mix) +
             node_input("fg", "surfaceshader", surface) + node_input("bg", "surfaceshader", last) +
             node_input("mix", "float", mask) + "  </mix>\n";
    last = mix;
  }
  nodes += "  <surfacematerial name=\"material\" type=\"material\">\n" +
           node_input("surfaceshader", "surfaceshader", last) + "  </surfacematerial>\n";
  const std::string file = udim_stem(in.name).value_or(in.name) + ".mtlx";
  folder.add(file, "<?xml version=\"1.0\"?>\n<materialx version=\"1.38\" colorspace=\"lin_rec709\">\n" + nodes +
                       "</materialx>\n");
  manifest["mtlx"] = file;
  add_manifest(manifest, folder);
}

}  // namespace redmap
