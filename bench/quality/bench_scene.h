// One object under one shadowed light, seen from as far away as a minification asks for.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "render/renderer.h"
#include "scene/scene.h"

namespace redmap::bench {

/// "sphere", "cylinder", or a mesh NAME_*.obj in `models`: bunny, dragon. Throws Error naming the file it looked for.
std::shared_ptr<const Surface> make_bench_surface(const std::string& object, const std::filesystem::path& models);

/// `object` with `shader`, turned to view `view`, such that the median over its pixels of the square root of
/// (pixel footprint area / texel area) is `minification` for maps of `map_size`. The picture holds the whole object, or
/// no more than the middle `largest` x `largest` pixels if that is not 0.
Scene make_bench_scene(const std::shared_ptr<const Surface>& surface, const std::shared_ptr<const Shader>& shader,
                       int map_size, double minification, int view, int largest = 0);

/// Moves the camera of `scene` along +z so that its minification becomes `minification`; the object's centre stays at
/// the origin, and the picture holds what make_bench_scene() says.
void place_camera(Scene& scene, double minification, int largest);

/// Of the sphere about the centre of its box that holds the surface.
float bounding_radius(const Surface& surface);

/// `scene` with its object turned further about its own centre.
Scene turned(const Scene& scene, double degrees);

/// That median, over pixels whose centre hits the object.
double median_minification(const Scene& scene);

/// Degrees by which the object has to turn for its nearest point to move by `pixels`.
double degrees_for_pixels(const Scene& scene, double pixels);

}  // namespace redmap::bench
