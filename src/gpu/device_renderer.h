// Frames on a Vulkan device: visibility by rasterisation, shading in compute shaders (docs/gpu.md). Samples stand on
// the grid of the CPU's renderer and have its footprints; the lookup and the integrals over normals are the same.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/image.h"
#include "device/device.h"
#include "map/object_data.h"
#include "scene/method.h"
#include "scene/scene.h"

namespace redmap {

struct DeviceRenderOptions {
  Method method = Method::kMap;         ///< any but kPaper
  Quality quality = Quality::kDefault;  ///< one sample a pixel or 2 x 2, for original and map
  /// A square number of samples a pixel, on a regular grid. supersample: 0 means 16. original: 0 means the
  /// map's.
  int spp = 0;
  /// Each sample takes one basis reflectance a light, drawn anew every frame: noise instead of time that grows with the
  /// basis (paper, section 7). Highlights are those of the mean normal; maps with normals take all.
  bool draws_one_basis = false;
};

/// Throws Error, one line, if `options` ask for what only the CPU does.
void require_device_method(const DeviceRenderOptions& options);

class DeviceRenderer {
 public:
  /// `data` has one entry an object. Throws Error where something that the method needs is missing or of something
  /// else, on what this renderer does not take (plug-ins, more than 64 lights), and where the
  /// device fails.
  DeviceRenderer(std::shared_ptr<Device> device, const Scene& scene, const DeviceRenderOptions& options,
                 const std::vector<ObjectData>& data);
  ~DeviceRenderer();
  DeviceRenderer(DeviceRenderer&&) noexcept;
  DeviceRenderer& operator=(DeviceRenderer&&) noexcept;

  /// Renders the same objects and lights as they stand in `scene`. The picture stays on the device.
  /// Returns the seconds it took. Throws Error where a shader of the user's own does not end, naming it.
  double render(const Scene& scene, int frame);
  /// What was rendered last: linear RGB.
  Image picture() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace redmap
