#include "gpu/device_object.h"

#include <algorithm>
#include <cmath>

#include "gpu/map_memory.h"
#include "gpu/parameter_memory.h"
#include "gpu/triangle_tree.h"
#include "scene/layer_limits.h"
#include "scene/placement.h"
#include "surface/mesh.h"

namespace redmap {
namespace {

/// Analytic surfaces are known by what they map: a sphere's map is twice as wide as high.
SurfaceKind kind_of(const Surface& surface) {
  if (surface.mesh()) return SurfaceKind::kMesh;
  const Extent extent = surface.map_extent(1);
  return extent.width == 2 * extent.height ? SurfaceKind::kSphere : SurfaceKind::kCylinder;
}

constexpr int kBoxTriangles = 12;
constexpr std::uint32_t kBoxIndices[3 * kBoxTriangles] = {0, 1, 3, 0, 3, 2, 4, 6, 7, 4, 7, 5, 0, 4, 5, 0, 5, 1,
                                                          2, 3, 7, 2, 7, 6, 0, 2, 6, 0, 6, 4, 1, 5, 7, 1, 7, 3};

std::array<Vec3, 8> box_corners(const Surface& surface, float margin) {
  const Vec3 extra = (surface.upper() - surface.lower()) * margin;
  const Vec3 lo = surface.lower() - extra, hi = surface.upper() + extra;
  std::array<Vec3, 8> corners;
  for (int i = 0; i < 8; ++i) corners[i] = {i & 1 ? hi.x : lo.x, i & 2 ? hi.y : lo.y, i & 4 ? hi.z : lo.z};
  return corners;
}

template <typename T>
std::span<const std::byte> bytes_of_all(const T& values) {
  return std::as_bytes(std::span(values));
}

bool is_posed(const Surface& surface) { return surface.pose_fingerprint() != surface.fingerprint(); }

/// Two vec4 a vertex: position, normal, uv.
void append_face(const TriangleMesh& mesh, std::size_t t, std::vector<float>& floats) {
  for (int k = 0; k < 3; ++k) {
    const Vec3 p = mesh.positions[mesh.triangles[t][k]], n = mesh.normals[mesh.normal_triangles[t][k]];
    const Vec2 uv = mesh.uv[mesh.uv_triangles[t][k]];
    floats.insert(floats.end(), {p.x, p.y, p.z, n.x, n.y, n.z, uv.x, uv.y});
  }
}

/// Of deformed meshes each face is followed by itself at rest.
std::vector<float> face_floats(const Surface& surface) {
  const bool posed = is_posed(surface);
  const std::size_t triangles = surface.mesh()->triangles.size();
  std::vector<float> floats;
  floats.reserve((posed ? 48 : 24) * triangles);
  for (std::size_t t = 0; t < triangles; ++t) {
    append_face(*surface.mesh(), t, floats);
    if (posed) append_face(*surface.mesh_at_rest(), t, floats);
  }
  return floats;
}

DeviceShader shader_for(const Object& object) {
  const ShaderInfo& info = object.shader->info();
  std::optional<DeviceShader> shader = device_shader(*object.shader);
  if (!shader)
    throw Error("object '{}': expected a shader in GLSL, found the plug-in '{}': render it without --device",
                object.name, info.name);
  return std::move(*shader);
}

/// Length of dp_du where a triangle has no shape in uv (surface/mesh_surface.cpp).
float average_scale(const Surface& surface) {
  return static_cast<float>(std::sqrt(surface.area() / std::max(surface.uv_area(), 1e-12)));
}

}  // namespace

DeviceObject::Geometry DeviceObject::make_geometry() const {
  const Device& device = *device_;
  if (const TriangleMesh* mesh = surface_->mesh()) {
    std::vector<float> faces = face_floats(*surface_);
    if (traits_.passes_light)
      for (const Vec4& v : triangle_tree(*mesh)) faces.insert(faces.end(), {v.x, v.y, v.z, v.w});
    return {LocalBuffer(device, bytes_of_all(mesh->positions)), LocalBuffer(device, bytes_of_all(mesh->triangles)),
            LocalBuffer(device, bytes_of_all(faces))};
  }
  // A hair larger than the surface, which its faces touch.
  constexpr float kMargin = 1e-3f;
  const std::array<Vec3, 8> corners = box_corners(*surface_, kMargin);
  return {LocalBuffer(device, bytes_of_all(corners)), LocalBuffer(device, bytes_of_all(kBoxIndices)),
          LocalBuffer(device, std::size_t{4})};
}

/// With what else it takes to read them.
LayeredTexture DeviceObject::make_texels(const ObjectData& data) {
  if (data.map) {
    set_map_traits(*data.map, *surface_, traits_), set_map_block(*data.map, traits_.is_fast, values_);
    data_ = LocalBuffer(*device_, bytes_of_all(map_data(*data.map, *surface_, traits_)));
    return make_weight_texture(*device_, *data.map);
  }
  if (data.parameters) {
    set_parameter_traits(data, traits_), set_parameter_block(data, values_);
    return make_parameter_texture(*device_, data);
  }
  return LayeredTexture(*device_, TexelKind::kBytes, {1, 1}, 1, 1, false, std::vector<std::byte>(4));
}

ObjectTraits DeviceObject::first_traits(const Object& object, const SceneTraits& scene) {
  ObjectTraits traits;
  traits.surface = kind_of(*object.surface);
  traits.posed = is_posed(*object.surface);
  traits.shadows = scene.shadows, traits.layers = scene.layers, traits.is_fast = scene.is_fast;
  traits.passes_light = scene.shadows && object.shader->info().transmits;
  return traits;
}

DeviceObject::DeviceObject(PipelineCache& cache, const Object& object, const ObjectData& data, const SceneTraits& scene,
                           std::uint32_t first_number, std::uint32_t index)
    : device_(cache.device()),
      surface_(object.surface),
      shader_(object.shader),
      text_(shader_for(object)),
      traits_(first_traits(object, scene)),
      transform_(object.transform),
      geometry_(make_geometry()),
      block_(*device_, sizeof(ObjectBlock)),
      parameters_(*device_, std::size_t{4}),
      patterns_(*device_, std::size_t{4}),
      data_(*device_, std::size_t{4}) {
  transmits_ = object.shader->info().transmits;
  texels_.push_back(make_texels(data));
  set_block(first_number, index);
  for (const Image& image : text_.images) images_.emplace_back(*device_, image);
  make_kernels(cache);
}

void DeviceObject::set_block(std::uint32_t first_number, std::uint32_t index) {
  const Vec3 size = surface_->upper() - surface_->lower();
  values_.shape = {1, 0.5f * size.x, size.y, average_scale(*surface_)};
  const TriangleMesh* mesh = surface_->mesh();
  const auto triangles = mesh ? static_cast<std::uint32_t>(mesh->triangles.size()) : 0;
  draw_triangles_ = mesh ? triangles : kBoxTriangles;
  values_.numbers.x = first_number;
  values_.numbers.y = mesh ? triangles : traits_.layers ? 2 : 1;
  values_.numbers.w = index;
}

void DeviceObject::make_kernels(PipelineCache& cache) {
  inputs_ = {kObjectBuffers, kObjectBindings - kObjectBuffers + static_cast<int>(images_.size()), sizeof(BandCall)};
  draw_numbers_ = &cache.draw(traits_.surface, traits_.layers ? TargetKind::kLayers : TargetKind::kNumbers);
  draw_depth_ = &cache.draw(traits_.surface, TargetKind::kDepth);
  sort_ = &cache.compute(sort_text(traits_), inputs_);
  group_ = &cache.compute(group_text(), inputs_);
  if (traits_.layers && traits_.shadows) receive_ = &cache.compute(receive_text(traits_), inputs_);
  parameters_ = LocalBuffer(*device_, std::span<const std::byte>(text_.parameters));
  if (traits_.basis == 0) return;
  const ShaderInfo& info = shader_->info();
  const ShaderSources text = bind_text(text_, info, traits_);
  const auto make = [&](ShadeStage stage) {
    shade_[static_cast<int>(stage)] = &cache.shade(text, !info.file.empty(), inputs_, stage);
  };
  make(ShadeStage::kBind);
  if (may_mix(text_, info, traits_)) make(ShadeStage::kMix);
  patterns_ = LocalBuffer(*device_, cache.pattern_size(text) * traits_.basis);
}

/// What the device wrote, unless no two reflectances mix.
void DeviceObject::find_groups() {
  if (!groups_) return;
  std::vector<std::uint32_t> words(groups_->size() / sizeof(std::uint32_t));
  std::memcpy(words.data(), groups_->data(), groups_->size());
  std::vector<int> groups(words.begin() + kListsHead, words.end());
  if (*std::ranges::max_element(groups) + 1 < traits_.basis) traits_.groups = std::move(groups);
  groups_.reset();
}

void DeviceObject::prepare(PipelineCache& cache) {
  if (shade_[static_cast<int>(ShadeStage::kNear)]) return;
  find_groups();
  const ShaderInfo& info = shader_->info();
  const ShaderSources text = shade_text(text_, info, traits_);
  for (const ShadeStage stage : {ShadeStage::kNear, ShadeStage::kFar, ShadeStage::kSpread, ShadeStage::kPass})
    if (needs(stage)) shade_[static_cast<int>(stage)] = &cache.shade(text, !info.file.empty(), inputs_, stage);
}

/// The shader itself needs one stage; parameters and maps with normals shade all that is filtered in one.
bool DeviceObject::needs(ShadeStage stage) const {
  switch (stage) {
    case ShadeStage::kBind:
    case ShadeStage::kMix:  // made by themselves
      return false;
    case ShadeStage::kNear:
      return true;
    case ShadeStage::kFar:  // a grain is drawn wherever it is
      return traits_.channels > 0 && (!traits_.has_grains || traits_.has_normals);
    case ShadeStage::kSpread:
      return traits_.basis > 0 && !traits_.has_normals;
    case ShadeStage::kPass:
      return traits_.passes_light;
  }
  return false;
}

void DeviceObject::attach(const FrameMemory& memory, CommandList& commands) {
  lists_ = memory.lists;
  number_bindings_ = std::make_unique<Bindings>(*draw_numbers_);
  number_bindings_->add(memory.views->buffer()).add(block_.buffer());
  if (traits_.layers) number_bindings_->add(*memory.paths);
  depth_bindings_ = std::make_unique<Bindings>(*draw_depth_);
  depth_bindings_->add(memory.views->buffer()).add(block_.buffer());
  bindings_ = std::make_unique<Bindings>(*sort_);
  bindings_->add(memory.frame->buffer()).add(block_.buffer()).add(geometry_.faces).add(*memory.lists);
  bindings_->add(*memory.radiance).add(parameters_).add(patterns_).add(data_).add(memory.views->buffer());
  bindings_->add(*memory.paths).add(*memory.seen).add(texels_.front()).add(*memory.shadows);
  for (const DeviceImage& image : images_) bindings_->add(image);
  if (const ComputePipeline* bind = shade_[static_cast<int>(ShadeStage::kBind)])
    commands.dispatch(*bind, *bindings_, bytes_of(BandCall{}), Workgroups{1, 1});
  const ComputePipeline* mix = shade_[static_cast<int>(ShadeStage::kMix)];
  if (!mix || shade_[static_cast<int>(ShadeStage::kNear)]) return;
  commands.dispatch(*mix, *bindings_, bytes_of(BandCall{}), Workgroups{1, 1});
  groups_ = std::make_unique<DeviceBuffer>(*device_, sizeof(std::uint32_t) * (kListsHead + traits_.basis));
  commands.copy(*memory.lists, *groups_, groups_->size());
}

void DeviceObject::place(const Transform& transform) {
  transform_ = transform;
  const Placement p = make_placement(transform);
  values_.axis_x = {p.rotation.x, p.translate.x};
  values_.axis_y = {p.rotation.y, p.translate.y};
  values_.axis_z = {p.rotation.z, p.translate.z};
  values_.shape.x = p.scale;
  values_.limits.x = kRayOffset * 0.5f * length(surface_->upper() - surface_->lower()) * p.scale;
  block_.set(values_);
}

void DeviceObject::record_draw(CommandList& commands, TargetKind kind, std::uint32_t view) const {
  const bool numbers = kind != TargetKind::kDepth;
  commands.draw(numbers ? *draw_numbers_ : *draw_depth_, numbers ? *number_bindings_ : *depth_bindings_, bytes_of(view),
                geometry_.positions, geometry_.indices, draw_triangles_);
}

/// Blocks of 8 x 8 samples that the object's box may be seen in; false if there are none in the band.
bool DeviceObject::cover(BandCall& call, const CameraRays& camera, int samples_a_side, int columns) const {
  const Placement placement = make_placement(transform_);
  const Vec3 forward = normalized(cross(camera.right_per_pixel, camera.down_per_pixel));
  const float across = dot(camera.right_per_pixel, camera.right_per_pixel);
  float x0 = 1e30f, y0 = 1e30f, x1 = -1e30f, y1 = -1e30f;
  const float near_end = 1e-3f * length(surface_->upper() - surface_->lower()) * placement.scale;
  for (const Vec3 corner : box_corners(*surface_, 1e-3f)) {
    const Vec3 q = placement.point_world(corner) - camera.origin;
    const float z = dot(q, forward);
    const Vec3 at = q / std::max(z, near_end) - camera.top_left;
    const bool behind = z < near_end;
    const float x = dot(at, camera.right_per_pixel) / across, y = dot(at, camera.down_per_pixel) / across;
    x0 = behind ? 0 : std::min(x0, x), y0 = behind ? 0 : std::min(y0, y);
    x1 = behind ? 1e9f : std::max(x1, x), y1 = behind ? 1e9f : std::max(y1, y);
  }
  const float n = static_cast<float>(samples_a_side), first = static_cast<float>(call.first_row);
  const auto block = [](float sample, int samples) {
    return static_cast<std::uint32_t>(std::clamp(sample, 0.0f, static_cast<float>(samples))) / 8;
  };
  const int rows = static_cast<int>(call.rows);
  const float top = y0 * n - first - 1, bottom = y1 * n - first + 1;
  if (bottom < 0 || top > static_cast<float>(rows) || x1 < 0 || x0 * n > static_cast<float>(columns)) return false;
  call.blocks.x = block(x0 * n - 1, columns), call.blocks.y = block(top, rows);
  call.blocks.z = block(x1 * n + 1, columns - 1) - call.blocks.x + 1;
  call.blocks.w = call.blocks.z * (block(bottom, rows - 1) - call.blocks.y + 1);
  return true;
}

void DeviceObject::record_receivers(CommandList& commands, BandCall call, const CameraRays& camera, int samples_a_side,
                                    int columns) const {
  if (cover(call, camera, samples_a_side, columns))
    commands.dispatch(*receive_, *bindings_, bytes_of(call), Workgroups{call.blocks.w, 1});
}

void DeviceObject::record_passing(CommandList& commands, BandCall call, int columns) const {
  if (!traits_.passes_light) return;
  const std::uint32_t samples = static_cast<std::uint32_t>(columns) * call.rows;
  commands.dispatch(*shade_[static_cast<int>(ShadeStage::kPass)], *bindings_, bytes_of(call),
                    Workgroups{(samples + 63) / 64, 1});
}

void DeviceObject::record_shading(CommandList& commands, BandCall call, const CameraRays& camera, int samples_a_side,
                                  int columns) const {
  if (!cover(call, camera, samples_a_side, columns)) return;
  if (traits_.channels == 0) call.filters = 0;
  commands.dispatch(*sort_, *bindings_, bytes_of(call), Workgroups{(call.blocks.w + 63) / 64, 1});
  commands.dispatch(*group_, *bindings_, bytes_of(call), Workgroups{1, 1});
  // Those that are blended add to what the shader itself left.
  for (const ShadeStage stage : {ShadeStage::kNear, ShadeStage::kFar, ShadeStage::kSpread}) {
    const ComputePipeline* shade = shade_[static_cast<int>(stage)];  // lists follow the counts in that order
    if (shade && (stage == ShadeStage::kNear || call.filters))
      commands.dispatch(*shade, *bindings_, bytes_of(call), *lists_, static_cast<std::size_t>(stage) * sizeof(UVec4));
  }
}

}  // namespace redmap
