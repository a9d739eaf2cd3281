// Shaders: of the library, of a file, or a Python function; and their radiance at places that arrays say.
#include "shader/shader.h"

#include <variant>

#include <nanobind/stl/variant.h>

#include "python_shader.h"
#include "surface_batch.h"
#include "user_shader/user_shader.h"

namespace redmap::python {
namespace {

using SharedShader = std::shared_ptr<const Shader>;
/// A parameter as Python writes it.
using ParameterValue = std::variant<float, std::vector<float>>;
using Parameters = std::map<std::string, ParameterValue>;
using Images = std::map<std::string, std::variant<std::filesystem::path, ShaderImage>>;

ParameterOverrides overrides_of(const Parameters& parameters) {
  ParameterOverrides overrides;
  for (const auto& [name, value] : parameters) {
    const float* one = std::get_if<float>(&value);
    overrides[name] = one ? std::vector{*one} : std::get<std::vector<float>>(value);
  }
  return overrides;
}

SharedShader shader(const std::string& name, const Parameters& parameters, const Images& images,
                    const std::string& device) {
  const ParameterOverrides overrides = overrides_of(parameters);
  const nb::gil_scoped_release release;
  if (!is_shader_file(name)) {
    if (!images.empty()) throw Error("shader \"{}\": expected images only for a file of your own, found some", name);
    return make_library_shader(name, overrides);
  }
  UserShaderSettings settings{overrides, {}, device};
  for (const auto& [image, file] : images) {
    const auto* path = std::get_if<std::filesystem::path>(&file);
    settings.images[image] = path ? ShaderImage{*path, false} : std::get<ShaderImage>(file);
  }
  return make_user_shader(name, name, settings);
}

SharedShader function_shader(nb::callable function, const std::optional<std::string>& name) {
  const std::string called =
      name ? *name : nb::cast<std::string>(nb::getattr(function, "__name__", nb::str("function")));
  return make_python_shader(std::move(function), called);
}

nb::dict parameters_of(const Shader& shader) {
  nb::dict values;
  for (std::size_t i = 0; i < shader.parameters().size(); ++i) {
    const std::vector<float>& value = shader.parameters()[i];
    const nb::str name(shader.info().parameters[i].name.c_str());
    if (value.size() == 1)
      values[name] = value.front();
    else
      values[name] = nb::tuple(nb::cast(value));
  }
  return values;
}

RowsOut<3> radiance(const SharedShader& shader, const RowsIn<3>& position, const RowsIn<3>& normal,
                    const RowsIn<3>& to_light, const RowsIn<3>& to_viewer, const std::optional<RowsIn<3>>& tangent,
                    const std::optional<RowsIn<2>>& uv, float time) {
  const std::size_t count = position.shape(0);
  const std::vector<Vec3> positions = vectors_of<Vec3>("position", position, count);
  const std::vector<Vec3> normals = vectors_of<Vec3>("normal", normal, count);
  const std::vector<Vec3> tangents = tangent ? vectors_of<Vec3>("tangent", *tangent, count) : std::vector<Vec3>(count);
  const std::vector<Vec2> uvs = uv ? vectors_of<Vec2>("uv", *uv, count) : std::vector<Vec2>(count);
  std::vector<SurfaceHit> hits(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Frame frame = make_frame(normals[i], tangents[i]);
    hits[i].position = positions[i], hits[i].uv = uvs[i];
    hits[i].normal = hits[i].geometric_normal = frame.z, hits[i].tangent = frame.x;
    hits[i].rest = {positions[i], frame.z, frame.x};
  }
  ShadingBatch batch = batch_of(std::move(hits), to_light, to_viewer);
  batch.time = time;
  return shade_batch(*make_shader_shading(shader), batch);
}

void bind_places(nb::module_& module) {
  nb::class_<Places>(module, "Places", doc::SurfacePoints)
      .def_prop_ro(
          "position",
          [](const Places& p) {
            return view_of<3>({p.points, &p.points->position});
          },
          nb::rv_policy::automatic)
      .def_prop_ro(
          "normal",
          [](const Places& p) {
            return view_of<3>({p.points, &p.points->normal});
          },
          nb::rv_policy::automatic)
      .def_prop_ro(
          "tangent",
          [](const Places& p) {
            return view_of<3>({p.points, &p.points->tangent});
          },
          nb::rv_policy::automatic)
      .def_prop_ro(
          "uv",
          [](const Places& p) {
            return view_of<2>({p.points, &p.points->uv});
          },
          nb::rv_policy::automatic)
      .def_prop_ro("time", [](const Places& p) { return p.points->time; })
      .def("__len__", [](const Places& p) { return p.points->size(); });
}

}  // namespace

void bind_shaders(nb::module_& module) {
  bind_places(module);
  nb::class_<ShaderImage>(module, "ShaderImage", doc::ShaderImage)
      .def(
          "__init__",
          [](ShaderImage* self, const std::filesystem::path& file, bool is_data) {
            new (self) ShaderImage{file, is_data};
          },
          "file"_a, "is_data"_a = false, doc::ShaderImage_is_data)
      .def_ro("file", &ShaderImage::file)
      .def_ro("is_data", &ShaderImage::is_data, doc::ShaderImage_is_data);
  nb::class_<Shader>(module, "Shader", "A procedural shader, with its parameters.")
      .def_prop_ro("name", [](const Shader& s) { return s.info().name; })
      .def_prop_ro(
          "summary", [](const Shader& s) { return s.info().summary; }, doc::ShaderInfo_summary)
      .def_prop_ro(
          "black_box", [](const Shader& s) { return s.info().black_box; }, doc::ShaderInfo_black_box)
      .def_prop_ro(
          "varies_in_time", [](const Shader& s) { return s.info().varies_in_time; }, doc::ShaderInfo_varies_in_time)
      .def_prop_ro("parameters", &parameters_of,
                   nb::sig("def parameters(self) -> dict[str, float | tuple[float, ...]]"), doc::Shader_parameters)
      .def(
          "radiance",
          [](const SharedShader& self, const RowsIn<3>& position, const RowsIn<3>& normal, const RowsIn<3>& to_light,
             const RowsIn<3>& to_viewer, const std::optional<RowsIn<3>>& tangent, const std::optional<RowsIn<2>>& uv,
             float time) { return radiance(self, position, normal, to_light, to_viewer, tangent, uv, time); },
          "position"_a, "normal"_a, "to_light"_a, "to_viewer"_a, "tangent"_a = nb::none(), "uv"_a = nb::none(),
          "time"_a = 0.0f,
          "What leaves N places towards the viewer under a light of unit irradiance, and the shader's emission: arrays "
          "(N, 3), and uv (N, 2), all in object space, unit directions away from the surface. Raises Error.");
  module.def(
      "shader", &shader, "name"_a, "parameters"_a = Parameters{}, "images"_a = Images{}, "device"_a = "",
      "The library's shader of that name, or that of a file: GLSL, MaterialX or a plug-in. Parameters that are not "
      "given keep their defaults. `images`: the files of its samplers. `device`: where a text runs. Raises Error.");
  module.def(
      "shader", &function_shader, "function"_a, "name"_a = nb::none(),
      "A Python function as a black box: function(places, to_light, to_viewer) gets arrays (N, 3) of unit "
      "directions in object space and returns the radiance, an array (N, 3): what leaves towards the viewer under "
      "a light of unit irradiance at normal incidence, cosine included. It should be a function of its arguments "
      "alone: it is asked in batches of any size and order. Maps know it by `name` and by its code.");
  module.def("library_shader_names", &library_shader_names, doc::library_shader_names);
}

}  // namespace redmap::python
