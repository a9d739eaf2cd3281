// Scenes: from files, or put together in Python.
#include "scene/scene.h"

#include "base/error.h"
#include "bindings.h"
#include "render/closest_view.h"
#include "scene/scene_file.h"

namespace redmap::python {

Scene scene_of(const PythonScene& scene) {
  return {scene.camera, nb::cast<std::vector<Light>>(scene.lights), nb::cast<std::vector<Object>>(scene.objects),
          scene.background, scene.time_seconds};
}

namespace {

PythonScene python_scene(const Scene& scene) {
  PythonScene made{scene.camera, {}, {}, scene.background, scene.time_seconds};
  for (const Light& light : scene.lights) made.lights.append(nb::cast(light));
  for (const Object& object : scene.objects) made.objects.append(nb::cast(object));
  return made;
}

SceneFile load_scene(const std::filesystem::path& path, const std::vector<std::string>& overrides,
                     const std::string& device) {
  const nb::gil_scoped_release release;
  SceneFile file = SceneFile::load(path, overrides, device);
  settle_map_sizes(file);
  return file;
}

void bind_camera(nb::module_& module) {
  nb::class_<Camera>(module, "Camera", doc::Camera)
      .def(
          "__init__",
          [](Camera* self, Vec3 position, Vec3 look_at, Vec3 up, float fov, int width, int height) {
            new (self) Camera{position, look_at, up, fov, width, height};
          },
          "position"_a = Camera{}.position, "look_at"_a = Camera{}.look_at, "up"_a = Camera{}.up,
          "vertical_fov_degrees"_a = Camera{}.vertical_fov_degrees, "width"_a = Camera{}.width,
          "height"_a = Camera{}.height)
      .def_rw("position", &Camera::position)
      .def_rw("look_at", &Camera::look_at)
      .def_rw("up", &Camera::up)
      .def_rw("vertical_fov_degrees", &Camera::vertical_fov_degrees)
      .def_rw("width", &Camera::width)
      .def_rw("height", &Camera::height);
}

void bind_light(nb::module_& module) {
  nb::class_<Light>(module, "Light", "A point light, or one from infinitely far.")
      .def_static(
          "point",
          [](Vec3 position, Rgb intensity, bool shadows) {
            return Light{Light::Type::kPoint, "", position, {}, intensity, shadows};
          },
          "position"_a, "intensity"_a = Rgb{1, 1, 1}, "shadows"_a = true, doc::Light_intensity)
      .def_static(
          "directional",
          [](Vec3 to_light, Rgb irradiance, bool shadows) {
            if (!(length(to_light) > 0)) throw Error("to_light: expected a direction, found zeros");
            return Light{Light::Type::kDirectional, "", {}, normalized(to_light), irradiance, shadows};
          },
          "to_light"_a, "irradiance"_a = Rgb{1, 1, 1}, "shadows"_a = true, doc::Light_intensity)
      .def_rw("name", &Light::name)
      .def_rw("position", &Light::position, doc::Light_position)
      .def_rw("to_light", &Light::to_light, doc::Light_to_light)
      .def_rw("intensity", &Light::intensity, doc::Light_intensity)
      .def_rw("shadows", &Light::shadows);
}

void bind_object(nb::module_& module) {
  nb::class_<Transform>(module, "Transform", doc::Transform)
      .def(
          "__init__",
          [](Transform* self, Vec3 translate, Vec3 rotate_degrees, float scale) {
            new (self) Transform{translate, rotate_degrees, scale};
          },
          "translate"_a = Vec3{}, "rotate_degrees"_a = Vec3{}, "scale"_a = 1.0f)
      .def_rw("translate", &Transform::translate)
      .def_rw("rotate_degrees", &Transform::rotate_degrees)
      .def_rw("scale", &Transform::scale);
  nb::class_<Object>(module, "Object", "A surface with its shader, somewhere in a scene.")
      .def(
          "__init__",
          [](Object* self, std::shared_ptr<const Surface> surface, std::shared_ptr<const Shader> shader,
             const std::string& name, const Transform& transform) {
            new (self) Object;
            self->surface = std::move(surface), self->shader = std::move(shader);
            self->name = self->declared_name = name, self->transform = transform;
          },
          "surface"_a, "shader"_a, "name"_a = "object", "transform"_a = Transform{})
      .def_rw("name", &Object::name, doc::Object_name)
      .def_rw("surface", &Object::surface)
      .def_rw("shader", &Object::shader)
      .def_rw("map_path", &Object::map_path, doc::Object_map_path)
      .def_rw("map_size", &Object::map_size, doc::Object_map_size)
      .def_rw("transform", &Object::transform);
}

}  // namespace

void bind_scenes(nb::module_& module) {
  bind_camera(module), bind_light(module), bind_object(module);
  nb::class_<PythonScene>(module, "Scene", doc::Scene)
      .def(
          "__init__",
          [](PythonScene* self, const std::vector<Object>& objects, const std::vector<Light>& lights,
             const Camera& camera, Rgb background) {
            new (self) PythonScene(python_scene({camera, lights, objects, background, 0}));
          },
          "objects"_a, "lights"_a, "camera"_a = Camera{}, "background"_a = Rgb{})
      .def_rw("camera", &PythonScene::camera)
      .def_rw("lights", &PythonScene::lights)
      .def_rw("objects", &PythonScene::objects)
      .def_rw("background", &PythonScene::background)
      .def_rw("time_seconds", &PythonScene::time_seconds);
  nb::class_<SceneFile>(module, "SceneFile", "A scene as its TOML file has it, over all frames.")
      .def_prop_ro("path", &SceneFile::path)
      .def_prop_ro("frame_count", &SceneFile::frame_count, doc::SceneFile_frame_count)
      .def_prop_ro("frames_per_second", &SceneFile::frames_per_second)
      .def_prop_ro("remarks", &SceneFile::remarks, doc::SceneFile_remarks)
      .def(
          "at", [](const SceneFile& file, int frame) { return python_scene(file.at(frame)); }, "frame"_a = 1,
          doc::SceneFile_at);
  module.def("load_scene", &load_scene, "path"_a, "overrides"_a = std::vector<std::string>{}, "device"_a = "",
             doc::SceneFile_load);
}

}  // namespace redmap::python
