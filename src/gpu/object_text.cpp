#include "gpu/object_text.h"

#include <fmt/format.h>

#include "gpu/frame_blocks.h"
#include "gpu/kernel_texts.h"
#include "gpu/limits_text.h"
#include "gpu/pattern_mixing.h"
#include "user_shader/stages.h"

namespace redmap {
namespace {

std::string head(SurfaceKind surface) {
  return fmt::format("#version 450\n#define REDMAP_SURFACE {}\n", static_cast<int>(surface)) + limits_text();
}

const char* layers_text(bool layers) { return layers ? "#define REDMAP_LAYERS\n" : ""; }

/// What finding a hit depends on.
std::string place_definitions(const ObjectTraits& traits) {
  return std::string(layers_text(traits.layers)) + (traits.posed ? "#define REDMAP_POSED\n" : "");
}

std::string guard_text(const ShaderInfo& info) {
  return fmt::format("{}const uint redmap_most_rounds = {}u;\n", info.file.empty() ? "" : "#define REDMAP_GUARDED\n",
                     kMostRounds);
}

/// The shader's own text between `before` and `after`.
ShaderSources full_text(const DeviceShader& shader, const ShaderInfo& info, const ObjectTraits& traits,
                        const std::string& before, const std::string& after) {
  ShaderSources all{"", shader.sources.names};
  all.names.push_back(shader.sources.names.front() + ", as redmap renders it");
  const std::string ours = fmt::format("#line 1 {}\n", all.names.size() - 1);
  all.text = head(traits.surface) + ours + shader_text_head(info) + trait_definitions(traits) + guard_text(info) +
             before + shader_text_body(shader.sources, info, kObjectBindings) + ours + after;
  return all;
}

}  // namespace

std::string draw_text(SurfaceKind surface, GlslStage stage, TargetKind kind) {
  const std::string numbers = kind != TargetKind::kDepth ? "#define REDMAP_NUMBERS\n" : "";
  return head(surface) + numbers + layers_text(kind == TargetKind::kLayers) +
         kernel_texts({"view", "object", "analytic", stage == GlslStage::kVertex ? "draw_vertex" : "draw_fragment"});
}

std::string sort_text(const ObjectTraits& traits) {
  return head(traits.surface) + place_definitions(traits) +
         kernel_texts({"view", "object", "analytic", "frame", "hit_type", "hit", "footprint", "sort"});
}

std::string receive_text(const ObjectTraits& traits) {
  return head(traits.surface) + place_definitions(traits) +
         kernel_texts({"view", "object", "analytic", "frame", "hit_type", "hit", "paths", "receive"});
}

std::string group_text() { return "#version 450\n" + kernel_texts({"frame", "group"}); }
std::string advance_text() { return "#version 450\n" + limits_text() + kernel_texts({"frame", "paths", "advance"}); }
std::string resolve_text(bool layers) {
  return std::string("#version 450\n") + layers_text(layers) + kernel_texts({"frame", "resolve"});
}

std::string trait_definitions(const ObjectTraits& traits) {
  const std::pair<const char*, std::size_t> numbers[] = {
      {"BASIS", traits.basis},       {"CHANNELS", traits.channels}, {"HAS_COVERAGE", traits.has_coverage},
      {"WRAPS", traits.wraps_u},     {"WIDTHS", traits.widths},     {"LEAVES", traits.leaves},
      {"GRAINS", traits.has_grains}, {"SLOPES", traits.first_slope}};
  const std::pair<const char*, bool> flags[] = {{"MENDS", traits.mends_seams}, {"HIDES_FRAMES", traits.hides_frames},
                                                {"SHADOWS", traits.shadows},   {"POSED", traits.posed},
                                                {"LAYERS", traits.layers},     {"PASSES", traits.passes_light},
                                                {"FAST", traits.is_fast},      {"DRAWS_NORMALS", traits.draws_normals}};
  std::string lines;
  for (const auto& [name, number] : numbers) lines += fmt::format("#define REDMAP_{} {}\n", name, number);
  for (const auto& [name, is_set] : flags)
    if (is_set) lines += fmt::format("#define REDMAP_{}\n", name);
  return lines;
}

std::string map_parts_text(const ObjectTraits& traits) {
  std::string text;
  if (traits.has_normals || traits.has_grains) text += kernel_text("gather");
  if (traits.has_normals) text += kernel_text("normals");
  if (traits.has_grains) text += kernel_text("grains");
  if (traits.leaves > 0) text += kernel_text("clusters");
  if (traits.mends_seams) text += kernel_text("seams");
  return text;
}

bool may_mix(const DeviceShader& shader, const ShaderInfo& info, const ObjectTraits& traits) {
  return traits.basis > 1 && !info.black_box && !traits.hides_frames && !traits.has_normals && !traits.has_grains &&
         !blend_text(shader.sources).empty();
}

ShaderSources bind_text(const DeviceShader& shader, const ShaderInfo& info, const ObjectTraits& traits) {
  return full_text(shader, info, traits,
                   kernel_texts({"view", "object", "analytic", "frame", "hit_type", "own_memory", "place"}),
                   kernel_texts({"own_patterns", "bind"}) +
                       (may_mix(shader, info, traits) ? "#define REDMAP_MIXES\n" + blend_text(shader.sources) : "") +
                       std::string(kernel_text("bind_main")));
}

ShaderSources shade_text(const DeviceShader& shader, const ShaderInfo& info, const ObjectTraits& traits) {
  std::string before = kernel_texts({"view", "object", "analytic", "frame"});
  if (traits.layers) before += kernel_text("paths");
  before += kernel_texts({"hit_type", "hit", "footprint", "own_memory", "place", "lights"});
  if (traits.passes_light) before += kernel_text("tree");
  std::string after = kernel_texts({"own_patterns", "bind", "shade"});
  if (traits.channels > 0) before += kernel_text("lookup");
  if (traits.basis > 0) {
    before += kernel_text("lobes");
    before += map_parts_text(traits);
    after += traits.groups.empty() ? std::string(kernel_text("unmixed"))
                                   : blend_text(shader.sources) + mixing_text(traits.groups);
    after += kernel_texts({"shade_map", "shade_spread", traits.has_normals ? "shade_normals" : "shade_turning"});
  } else if (traits.channels > 0) {
    after += library_include_text("include/widened.glsl") + std::string(kernel_text("shade_parameters"));
  }
  if (traits.passes_light) after += kernel_text("pass_light");
  after += kernel_text("shade_main");
  return full_text(shader, info, traits, before, after);
}

}  // namespace redmap
