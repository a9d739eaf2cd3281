// What `redmap bench normals` varies: bumps, glosses, and the object that wears them, all one library shader.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace redmap::bench {

/// Names, in the order of the table.
std::vector<std::string> bump_names();
std::vector<std::string> gloss_names();

/// Whether they make a case: the bump "grain" with anisotropic glosses, all others with the others.
bool go_together(const std::string& bump, const std::string& gloss);

/// The shader `bumps`, or `brushed_metal` for a grain, as one case, its features as large in texels on every surface:
/// `texel` is a texel's width in object units. `busy`: evaluations of noise that change nothing. Throws Error naming
/// what there is.
std::shared_ptr<const Shader> make_bumpy_shader(const std::string& bump, const std::string& gloss, double texel,
                                                int busy);
/// Whether that shader is one reflectance about varying normals.
bool is_single_basis(const std::string& bump);

/// "plane", or what make_bench_surface() knows.
std::shared_ptr<const Surface> make_bumpy_surface(const std::string& object, const std::filesystem::path& models);
/// Mean width of a texel, object units.
double texel_width(const Surface& surface, int map_size);

/// One view of it, no more than `largest` pixels a side. The plane is seen at 40 degrees, its light opposite; other
/// objects as make_bench_scene() does.
Scene make_bumpy_scene(const std::string& object, const std::shared_ptr<const Surface>& surface,
                       const std::shared_ptr<const Shader>& shader, int map_size, double minification, int view,
                       int largest);

}  // namespace redmap::bench
