#include "gpu/object_text.h"

#include <fmt/format.h>

#include "gpu/frame_blocks.h"
#include "gpu/kernel_texts.h"
#include "gpu/limits_text.h"
#include "user_shader/stages.h"

namespace redmap {
namespace {

std::string head(SurfaceKind surface) {
  return fmt::format("#version 450\n#define REDMAP_SURFACE {}\n", static_cast<int>(surface)) + limits_text();
}

std::string definitions(const ShaderInfo& info, const ObjectTraits& traits) {
  std::string lines = fmt::format("#define REDMAP_BASIS {}\n#define REDMAP_HAS_COVERAGE {}\n", traits.basis,
                                  traits.has_coverage ? 1 : 0);
  lines += fmt::format("#define REDMAP_CHANNELS {}\n#define REDMAP_SLOPES {}\n", traits.channels, traits.first_slope);
  lines += fmt::format("#define REDMAP_WRAPS {}\n#define REDMAP_WIDTHS {}\n", traits.wraps_u ? 1 : 0, traits.widths);
  lines += fmt::format("#define REDMAP_LEAVES {}\n", traits.leaves);
  if (traits.mends_seams) lines += "#define REDMAP_MENDS\n";
  if (traits.hides_frames) lines += "#define REDMAP_HIDES_FRAMES\n";
  if (traits.shadows) lines += "#define REDMAP_SHADOWS\n";
  if (traits.draws_normals) lines += "#define REDMAP_DRAWS_NORMALS\n";
  if (!info.file.empty()) lines += "#define REDMAP_GUARDED\n";
  return lines + fmt::format("const uint redmap_most_rounds = {}u;\n", kMostRounds);
}

}  // namespace

std::string draw_text(SurfaceKind surface, GlslStage stage, TargetKind kind) {
  const std::string numbers = kind == TargetKind::kNumbers ? "#define REDMAP_NUMBERS\n" : "";
  return head(surface) + numbers +
         kernel_texts({"view", "object", "analytic", stage == GlslStage::kVertex ? "draw_vertex" : "draw_fragment"});
}

std::string sort_text(SurfaceKind surface) {
  return head(surface) + kernel_texts({"view", "object", "analytic", "frame", "hit_type", "hit", "footprint", "sort"});
}

std::string group_text() { return "#version 450\n" + kernel_texts({"frame", "group"}); }
std::string resolve_text() { return "#version 450\n" + kernel_texts({"frame", "resolve"}); }

ShaderSources shade_text(const DeviceShader& shader, const ShaderInfo& info, const ObjectTraits& traits) {
  ShaderSources all{"", shader.sources.names};
  all.names.push_back(shader.sources.names.front() + ", as redmap renders it");
  const std::string ours = fmt::format("#line 1 {}\n", all.names.size() - 1);
  std::string before = kernel_texts(
      {"view", "object", "analytic", "frame", "hit_type", "hit", "footprint", "own_memory", "place", "lights"});
  std::string after = kernel_texts({"own_patterns", "bind", "shade"});
  if (traits.channels > 0) before += kernel_text("lookup");
  if (traits.basis > 0) {
    before += kernel_text("lobes");
    if (traits.has_normals) before += kernel_text("normals");
    if (traits.leaves > 0) before += kernel_text("clusters");
    if (traits.mends_seams) before += kernel_text("seams");
    after += kernel_texts({"shade_map", "shade_spread", traits.has_normals ? "shade_normals" : "shade_turning"});
  } else if (traits.channels > 0) {
    after += library_include_text("include/widened.glsl") + std::string(kernel_text("shade_parameters"));
  }
  after += kernel_text("shade_main");
  all.text = head(traits.surface) + ours + shader_text_head(info) + definitions(info, traits) + before +
             shader_text_body(shader.sources, info, kObjectBindings) + ours + after;
  return all;
}

}  // namespace redmap
