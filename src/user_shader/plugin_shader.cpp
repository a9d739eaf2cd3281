#include "user_shader/plugin_shader.h"

#include <dlfcn.h>

#include <algorithm>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/hash.h"
#include "shader/parameter_values.h"
#include "shader/shader_text.h"
#include "user_shader/function_error.h"
#include "user_shader/plugin.h"

namespace redmap {
namespace {

/// A pattern is a place on the surface boiled down: one larger than this is a mistake.
constexpr std::size_t kLargestPattern = 1 << 16;

/// An open shared library.
class Library {
 public:
  explicit Library(const std::filesystem::path& file)
      : handle_(dlopen(std::filesystem::absolute(file).c_str(), RTLD_NOW | RTLD_LOCAL)) {
    if (!handle_) throw Error("{}: expected a shared library, but: {}", file.string(), dlerror());
  }
  ~Library() { dlclose(handle_); }
  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;
  void* find(const char* symbol) const { return dlsym(handle_, symbol); }

 private:
  void* handle_;
};

/// Throws Error unless `plugin` is whole.
void check_plugin(const RedmapPlugin* plugin, const std::string& where) {
  if (!plugin) throw Error("{}: expected redmap_plugin() to return a plug-in, found null", where);
  if (plugin->version != REDMAP_PLUGIN_VERSION)
    throw Error("{}: expected a plug-in of version {}, found {}", where, REDMAP_PLUGIN_VERSION, plugin->version);
  if (!plugin->declaration || !plugin->bind || !plugin->radiance)
    throw Error("{}: expected a declaration, bind and radiance, found one of them null", where);
  if (plugin->pattern_size == 0 || plugin->pattern_size > kLargestPattern)
    throw Error("{}: expected a pattern of 1 to {} bytes, found {}", where, kLargestPattern, plugin->pattern_size);
}

/// What a plug-in's patterns share.
struct Plugin {
  Library library;
  const RedmapPlugin* functions = nullptr;
  ShaderInfo info;
  ParameterValues values;
  std::vector<float> parameters;  ///< flat

  Plugin(const std::filesystem::path& file, const std::string& name) : library(file) {
    const auto entry = reinterpret_cast<RedmapPluginEntry>(library.find("redmap_plugin"));
    if (!entry) throw Error("{}: expected a function redmap_plugin, found none", file.string());
    functions = entry();
    check_plugin(functions, file.string());
    info = parse_declaration(functions->declaration, file.string() + ": declaration");
    info.name = name, info.file = file;
    info.transmits = functions->transmittance, info.emits = functions->emission;
    info.perturbs_normals = functions->shading_normal, info.varies_in_time = functions->varies_in_time != 0;
    const std::string bytes = read_file(file);
    info.text_hash = hash_bytes(0, bytes.data(), bytes.size());
  }
};

RedmapPlaces places_of(const SurfacePoints& points) {
  RedmapPlaces places{};
  places.count = points.size(), places.time = points.time;
  for (int c = 0; c < 3; ++c)
    places.position[c] = points.position[c], places.normal[c] = points.normal[c], places.tangent[c] = points.tangent[c];
  for (int c = 0; c < 2; ++c) places.uv[c] = points.uv[c];
  return places;
}

RedmapPairs pairs_of(const DirectionPairs& pairs) {
  RedmapPairs result{};
  result.count = pairs.size();
  for (int c = 0; c < 3; ++c) result.to_light[c] = pairs.to_light[c], result.to_viewer[c] = pairs.to_viewer[c];
  return result;
}

using Rows = std::array<float*, 3>;
Rows rows_of(Planes<3>& planes) { return {planes[0], planes[1], planes[2]}; }

class PluginPatterns final : public BoundPatterns {
 public:
  PluginPatterns(std::shared_ptr<const Plugin> plugin, const SurfacePoints& points)
      : plugin_(std::move(plugin)), position_(points.position) {
    const RedmapPlugin& functions = *plugin_->functions;
    const RedmapPlaces places = places_of(points);
    // As aligned as any plain C type.
    patterns_.resize((size() * functions.pattern_size + sizeof(Block) - 1) / sizeof(Block));
    functions.bind(plugin_->parameters.data(), &places, patterns_.data());
    if (!functions.shading_normal) return;
    normals_.resize(size());
    const Rows rows = rows_of(normals_);
    functions.shading_normal(plugin_->parameters.data(), &places, rows.data());
    check([&] { require_unit(rows, size(), "shading_normal"); });
  }

  std::size_t size() const override { return position_.size(); }

  void radiance_each(const DirectionPairs& pairs, Planes<3>& out) const override {
    out.resize(size());
    ask(patterns_.data(), false, pairs_of(pairs), rows_of(out));
  }
  void radiance_one(std::size_t pattern, const DirectionPairs& pairs, Planes<3>& out) const override {
    out.resize(pairs.size());
    const auto* bytes = reinterpret_cast<const std::byte*>(patterns_.data());
    try {
      ask_unchecked(bytes + pattern * plugin_->functions->pattern_size, true, pairs_of(pairs), rows_of(out));
    } catch (const FunctionError& error) {
      fail_at(error, plugin_->info.name, position_.get(pattern));
    }
  }
  void radiance_all(const DirectionPairs& pairs, LaneVector<float>& out) const override {
    const std::size_t stride = padded(size());
    out.resize(pairs.size() * 3 * stride);
    DirectionPairs same;
    same.resize(size());
    for (std::size_t p = 0; p < pairs.size(); ++p) {
      for (int c = 0; c < 3; ++c)
        std::fill_n(same.to_light[c], size(), pairs.to_light[c][p]),
            std::fill_n(same.to_viewer[c], size(), pairs.to_viewer[c][p]);
      float* to = out.data() + p * 3 * stride;
      ask(patterns_.data(), false, pairs_of(same), {to, to + stride, to + 2 * stride});
    }
  }

  void transmittance(Planes<3>& out) const override {
    constant(plugin_->functions->transmittance, "transmittance", out);
  }
  void emission(Planes<3>& out) const override { constant(plugin_->functions->emission, "emission", out); }
  bool materials(Materials&) const override { return false; }
  bool shading_normals(Planes<3>& out) const override {
    if (!plugin_->info.perturbs_normals) return false;
    out = normals_;
    return true;
  }

 private:
  using Block = std::max_align_t;

  template <typename Body>
  void check(const Body& body) const {
    try {
      body();
    } catch (const FunctionError& error) {
      fail_at(error, plugin_->info.name, position_.get(error.place()));
    }
  }
  void ask_unchecked(const void* patterns, bool one_pattern, const RedmapPairs& pairs, const Rows& rows) const {
    plugin_->functions->radiance(plugin_->parameters.data(), patterns, one_pattern, &pairs, rows.data());
    require_finite(rows, pairs.count, "radiance");
  }
  void ask(const void* patterns, bool one_pattern, const RedmapPairs& pairs, const Rows& rows) const {
    check([&] { ask_unchecked(patterns, one_pattern, pairs, rows); });
  }
  template <typename Function>
  void constant(Function function, std::string_view name, Planes<3>& out) const {
    out = Planes<3>(size());
    if (!function) return;
    const Rows rows = rows_of(out);
    function(plugin_->parameters.data(), patterns_.data(), size(), rows.data());
    check([&] { require_finite(rows, size(), name); });
  }

  std::shared_ptr<const Plugin> plugin_;
  Planes<3> position_, normals_;
  std::vector<Block> patterns_;
};

class PluginShader final : public Shader {
 public:
  explicit PluginShader(std::shared_ptr<const Plugin> plugin) : plugin_(std::move(plugin)) {}
  const ShaderInfo& info() const override { return plugin_->info; }
  const ParameterValues& parameters() const override { return plugin_->values; }
  std::unique_ptr<BoundPatterns> bind(const SurfacePoints& points) const override {
    return std::make_unique<PluginPatterns>(plugin_, points);
  }

 private:
  std::shared_ptr<const Plugin> plugin_;
};

}  // namespace

ShaderInfo plugin_info(const std::filesystem::path& file, const std::string& name) { return Plugin(file, name).info; }

std::shared_ptr<const Shader> make_plugin_shader(const std::filesystem::path& file, const std::string& name,
                                                 const UserShaderSettings& settings) {
  auto plugin = std::make_shared<Plugin>(file, name);
  if (!settings.images.empty())
    throw Error("shader \"{}\": expected no images for a plug-in, found \"{}\"", name, settings.images.begin()->first);
  plugin->values = parameter_values(plugin->info, settings.parameters);
  for (const std::vector<float>& value : plugin->values)
    plugin->parameters.insert(plugin->parameters.end(), value.begin(), value.end());
  return std::make_shared<PluginShader>(std::move(plugin));
}

}  // namespace redmap
