#include <fmt/format.h>

#include "gpu/device_object.h"

namespace redmap {

const ComputePipeline& PipelineCache::compute(const std::string& text, const PipelineInputs& inputs) {
  auto& made = compute_[fmt::format("{} images: {}", inputs.images, text)];
  if (!made)
    made = std::make_unique<ComputePipeline>(*device_, compile_own_glsl(text, "kernel", GlslStage::kCompute), inputs);
  return *made;
}

const GraphicsPipeline& PipelineCache::draw(SurfaceKind surface, TargetKind kind) {
  auto& made = draws_[3 * static_cast<int>(surface) + static_cast<int>(kind)];
  if (made) return *made;
  const auto compiled = [&](GlslStage stage) {
    return compile_own_glsl(draw_text(surface, stage, kind), "draw", stage);
  };
  made =
      std::make_unique<GraphicsPipeline>(*device_, compiled(GlslStage::kVertex), compiled(GlslStage::kFragment), kind,
                                         PipelineInputs{kind == TargetKind::kLayers ? 3 : 2, 0, sizeof(std::uint32_t)});
  return *made;
}

const ComputePipeline& PipelineCache::shade(const ShaderSources& text, bool is_user_text, const PipelineInputs& inputs,
                                            ShadeStage stage) {
  auto& made = compute_[text.text + static_cast<char>('0' + static_cast<int>(stage))];
  if (made) return *made;
  auto& spirv = shade_spirv_[text.text];
  if (spirv.empty())
    spirv = is_user_text ? compile_glsl(text.text, text.names, kShadeLoopGuard)
                         : compile_own_glsl(text.text, text.names.front(), GlslStage::kCompute);
  made = std::make_unique<ComputePipeline>(*device_, spirv, inputs, static_cast<std::uint32_t>(stage));
  return *made;
}

std::size_t PipelineCache::pattern_size(const ShaderSources& text) const {
  return array_stride(shade_spirv_.at(text.text), "RedmapPatterns");
}

}  // namespace redmap
