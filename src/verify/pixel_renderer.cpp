#include "verify/pixel_renderer.h"

#include <span>

#include "render/tile.h"

namespace redmap {

PixelRenderer::PixelRenderer(const Object& object)
    : scene_(scene_of(object)), tracer_(scene_), original_(make_shader_shading(object.shader)) {
  tracer_.set_frame(scene_);
}

FrameContext PixelRenderer::context(const Scene& scene, const std::unique_ptr<ObjectShading>& shading) const {
  const bool transmits = scene.objects.front().shader->info().transmits;
  return {&scene, make_camera_rays(scene.camera), &tracer_, {&shading, 1}, {&original_, 1}, transmits};
}

RenderedPixel PixelRenderer::supersample(const PixelCase& pixel, const std::unique_ptr<ObjectShading>& shading, int spp,
                                         std::uint64_t seed) const {
  RenderOptions options;
  options.method = Method::kSupersample;
  options.spp = spp;
  const Scene scene = scene_of(scene_, pixel);
  const FrameContext frame = context(scene, shading);
  const std::vector<std::uint8_t> none(1, 0);
  float rgb[3] = {};
  RenderedPixel rendered;
  render_supersampled({&frame, &options, &none, 1, hash64(pixel.seed, seed), {rgb}, &rendered.seen}, {0, 0, 1, 1});
  rendered.value = {rgb[0], rgb[1], rgb[2]};
  return rendered;
}

RenderedPixel PixelRenderer::frame(const PixelCase& pixel, const std::unique_ptr<ObjectShading>& shading,
                                   Quality quality, bool supersampled) const {
  RenderOptions options;
  options.method = Method::kMap;
  options.quality = quality;
  const Scene scene = scene_of(scene_, pixel);
  FrameContext frame = context(scene, shading);
  set_quality(options, frame);
  const std::vector<std::uint8_t> by_object(1, supersampled);
  float rgb[3] = {};
  RenderedPixel rendered;
  render_grid({&frame, &options, &by_object, 1, hash64(pixel.seed), {rgb, &rendered.decision}, nullptr}, {0, 0, 1, 1});
  rendered.value = {rgb[0], rgb[1], rgb[2]};
  return rendered;
}

}  // namespace redmap
