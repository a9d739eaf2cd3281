// One object of a scene on a device: its triangles, its map, and the shaders that draw and shade it. Not part of the
// public interface.
#pragma once

#include <map>
#include <memory>

#include "gpu/frame_blocks.h"
#include "gpu/object_text.h"
#include "map/object_data.h"
#include "scene/camera_rays.h"
#include "scene/scene.h"

namespace redmap {

/// Pipelines by their texts: objects with the same shader share them.
class PipelineCache {
 public:
  explicit PipelineCache(std::shared_ptr<Device> device) : device_(std::move(device)) {}
  const std::shared_ptr<Device>& device() const { return device_; }

  const ComputePipeline& compute(const std::string& text, const PipelineInputs& inputs);
  const GraphicsPipeline& draw(SurfaceKind surface, TargetKind kind);
  const ComputePipeline& shade(const ShaderSources& text, bool is_user_text, const PipelineInputs& inputs,
                               ShadeStage stage);
  /// Bytes of a bound pattern of a text that shade() has compiled.
  std::size_t pattern_size(const ShaderSources& text) const;

 private:
  std::shared_ptr<Device> device_;
  std::map<std::string, std::vector<std::uint32_t>> shade_spirv_;
  std::map<std::string, std::unique_ptr<ComputePipeline>> compute_;
  std::map<int, std::unique_ptr<GraphicsPipeline>> draws_;
};

/// What all objects of a frame are given.
struct FrameMemory {
  const SharedBytes *frame, *views;
  const LocalBuffer *lists, *radiance;
  const RenderTarget *seen, *shadows;
};

class DeviceObject {
 public:
  /// `first_number`: of the object's triangles in the picture of numbers; `index`: of the object. `data`: a map, or
  /// parameters, or neither where the shader itself is to be used. Throws Error on surfaces, shaders and maps that this
  /// renderer does not take.
  DeviceObject(PipelineCache& cache, const Object& object, const ObjectData& data, bool shadows,
               std::uint32_t first_number, std::uint32_t index);

  std::uint32_t numbers() const { return numbers_; }

  /// To be called once, before the first frame. Binds the basis on the device.
  void attach(const FrameMemory& memory, CommandList& commands);
  /// Where it stands in this frame.
  void place(const Transform& transform);
  void record_upload(CommandList& commands) const { block_.record_upload(commands); }
  /// Into the target that was begun, by view `view`.
  void record_draw(CommandList& commands, TargetKind kind, std::uint32_t view) const;
  /// Sorts and shades its samples in a band. `call.blocks` is filled in by what the object may cover.
  void record_shading(CommandList& commands, BandCall call, const CameraRays& camera, int samples_a_side,
                      int columns) const;

 private:
  struct Geometry {
    LocalBuffer positions, indices, faces;
  };
  Geometry make_geometry() const;
  LayeredTexture make_texels(const ObjectData& data);
  bool cover(BandCall& call, const CameraRays& camera, int samples_a_side, int columns) const;

  std::shared_ptr<Device> device_;
  std::shared_ptr<const Surface> surface_;
  ObjectTraits traits_;
  ObjectBlock values_;
  Transform transform_;
  std::uint32_t numbers_ = 0, draw_triangles_ = 0;
  Geometry geometry_;
  SharedBytes block_;
  LocalBuffer parameters_, patterns_, data_;
  std::vector<LayeredTexture> texels_;  ///< one
  std::vector<DeviceImage> images_;
  const LocalBuffer* lists_ = nullptr;
  const GraphicsPipeline *draw_numbers_ = nullptr, *draw_depth_ = nullptr;
  const ComputePipeline *sort_ = nullptr, *group_ = nullptr;
  const ComputePipeline* shade_[kShadeStages] = {};
  std::unique_ptr<Bindings> number_bindings_, depth_bindings_, bindings_;
};

}  // namespace redmap
