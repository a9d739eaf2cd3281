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
  const LocalBuffer *lists, *radiance, *paths;
  const RenderTarget *seen, *shadows;
};

/// What the whole scene asks of every object.
struct SceneTraits {
  bool shadows = false;  ///< whether any light casts some
  bool layers = false;   ///< whether any object lets light pass
  bool is_fast = false;  ///< whether frames are to be fast rather than the CPU's
};

class DeviceObject {
 public:
  /// `first_number`: of the object's triangles in the picture of numbers; `index`: of the object. `data`: a map, or
  /// parameters, or neither where the shader itself is to be used. Throws Error on surfaces, shaders and maps that this
  /// renderer does not take.
  DeviceObject(PipelineCache& cache, const Object& object, const ObjectData& data, const SceneTraits& scene,
               std::uint32_t first_number, std::uint32_t index);

  /// In the picture of numbers: triangles of a mesh; of other surfaces 1, and in layers another where rays go out.
  std::uint32_t numbers() const { return values_.numbers.y; }
  bool transmits() const { return transmits_; }

  /// To be called before the first frame and when that memory has changed. Binds the basis on the device.
  void attach(const FrameMemory& memory, CommandList& commands);
  /// To be called when what attach() recorded has run: makes what shades, by what the basis turned out to be like.
  void prepare(PipelineCache& cache);
  /// Where it stands in this frame.
  void place(const Transform& transform);
  void record_upload(CommandList& commands) const { block_.record_upload(commands); }
  /// Into the target that was begun, by view `view`.
  void record_draw(CommandList& commands, TargetKind kind, std::uint32_t view) const;
  /// In layers: where its samples in a band are lit; then, when those of all objects are known, how much of each light
  /// passes this object on the way to any of them.
  void record_receivers(CommandList& commands, BandCall call, const CameraRays& camera, int samples_a_side,
                        int columns) const;
  void record_passing(CommandList& commands, BandCall call, int columns) const;
  /// Sorts and shades its samples in a band. `call.blocks` is filled in by what the object may cover.
  void record_shading(CommandList& commands, BandCall call, const CameraRays& camera, int samples_a_side,
                      int columns) const;

 private:
  struct Geometry {
    LocalBuffer positions, indices, faces;
  };
  Geometry make_geometry() const;
  static ObjectTraits first_traits(const Object& object, const SceneTraits& scene);
  bool needs(ShadeStage stage) const;
  void set_block(std::uint32_t first_number, std::uint32_t index);
  void make_kernels(PipelineCache& cache);
  LayeredTexture make_texels(const ObjectData& data);
  void find_groups();
  bool cover(BandCall& call, const CameraRays& camera, int samples_a_side, int columns) const;

  std::shared_ptr<Device> device_;
  std::shared_ptr<const Surface> surface_;
  std::shared_ptr<const Shader> shader_;
  DeviceShader text_;
  PipelineInputs inputs_;
  ObjectTraits traits_;
  ObjectBlock values_;
  Transform transform_;
  std::uint32_t draw_triangles_ = 0;
  bool transmits_ = false;
  Geometry geometry_;
  SharedBytes block_;
  LocalBuffer parameters_, patterns_, data_;
  std::vector<LayeredTexture> texels_;  ///< one
  std::vector<DeviceImage> images_;
  const LocalBuffer* lists_ = nullptr;
  const GraphicsPipeline *draw_numbers_ = nullptr, *draw_depth_ = nullptr;
  const ComputePipeline *sort_ = nullptr, *group_ = nullptr, *receive_ = nullptr;
  const ComputePipeline* shade_[kShadeStages] = {};
  std::unique_ptr<DeviceBuffer> groups_;  ///< as they come back, after the counts of the lists
  std::unique_ptr<Bindings> number_bindings_, depth_bindings_, bindings_;
};

}  // namespace redmap
