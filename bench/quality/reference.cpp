#include "reference.h"

#include <memory>

#include "metrics/compare.h"

namespace redmap::bench {

namespace {

// Every random number of a reference comes from here, every one of a method from seed 0.
constexpr std::uint64_t kReferenceSeed = 0x7265666572656e63;

RenderedFrame render_half(const Scene& scene, const std::vector<ObjectData>& data, int spp, std::uint64_t half,
                          int frame) {
  RenderOptions options;
  options.method = Method::kSupersample;
  options.spp = spp;
  options.seed = kReferenceSeed + half;
  options.classify = true;
  return Renderer(scene, options, data).render(scene, frame);
}

}  // namespace

Image render_reference(const Scene& scene, const std::vector<ObjectData>& data, int spp, int frame,
                       std::vector<PixelClass>& classes, ErrorSums& between_halves) {
  RenderedFrame a = render_half(scene, data, spp / 2, 0, frame);
  const RenderedFrame b = render_half(scene, data, spp / 2, 1, frame);
  between_halves.add(a.image, b.image, a.classes);
  classes = std::move(a.classes);
  for (std::size_t i = 0; i < a.image.data.size(); ++i) a.image.data[i] = 0.5f * (a.image.data[i] + b.image.data[i]);
  return std::move(a.image);
}

Image interior_mask(const Image& image, std::span<const PixelClass> classes) {
  Image mask(image.width, image.height, 1);
  for (std::size_t i = 0; i < classes.size(); ++i)
    mask.data[i] = classes[i] == PixelClass::kInterior || classes[i] == PixelClass::kSeam;
  return mask;
}

std::vector<double> measure_flicker(const std::function<Scene(int)>& scene_at, const std::vector<ObjectData>& data,
                                    const std::vector<RenderOptions>& methods, int frames, int reference_spp) {
  std::vector<std::unique_ptr<Renderer>> renderers;
  for (const RenderOptions& method : methods)
    renderers.push_back(std::make_unique<Renderer>(scene_at(0), method, data));
  std::vector<FlickerMeter> meters(methods.size());
  ErrorSums unused;
  for (int frame = 0; frame < frames; ++frame) {
    const Scene scene = scene_at(frame);
    std::vector<PixelClass> classes;
    const Image reference = render_reference(scene, data, reference_spp, frame, classes, unused);
    const Image mask = interior_mask(reference, classes);
    for (std::size_t i = 0; i < methods.size(); ++i)
      meters[i].add(renderers[i]->render(scene, frame).image, reference, &mask);
  }
  std::vector<double> flicker;
  for (const FlickerMeter& meter : meters) flicker.push_back(meter.flicker());
  return flicker;
}

}  // namespace redmap::bench
