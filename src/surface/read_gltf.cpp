// glTF 2.0 and GLB through tinygltf: the triangles of every mesh a node of the scene places, in world space, v upwards.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>

#include "base/error.h"
#include "surface/gltf_document.h"
#include "surface/gltf_primitive.h"
#include "surface/mesh_files.h"

namespace redmap {

namespace {

/// Deeper than any sound scene; a cycle of nodes ends here.
constexpr int kDeepestNode = 256;

/// Extensions that a file may require: those that are read, and those that have nothing to do with shape.
constexpr std::string_view kKnownExtensions[] = {"KHR_draco_mesh_compression", "KHR_mesh_quantization",
                                                 "KHR_texture_transform",      "KHR_lights_punctual",
                                                 "KHR_texture_basisu",         "EXT_texture_webp"};

class GltfMesh {
 public:
  GltfMesh(const std::filesystem::path& path, const tinygltf::Model& model, int uv_set)
      : path_(path), model_(model), uv_name_(fmt::format("TEXCOORD_{}", uv_set)) {}

  TriangleMesh read() {
    if (model_.scenes.empty()) {
      for (int node = 0; node < static_cast<int>(model_.nodes.size()); ++node)
        if (!is_child(node)) add_node(node, Eigen::Affine3d::Identity(), 0);
    } else {
      const int scene = model_.defaultScene < 0 ? 0 : model_.defaultScene;
      for (const int node : at(model_.scenes, scene, "scene").nodes) add_node(node, Eigen::Affine3d::Identity(), 0);
    }
    if (mesh_.triangles.empty()) fail("expected a mesh of triangles that a node of the scene places, found none");
    if (!has_uv_) mesh_.uv.clear(), mesh_.uv_triangles.clear();
    if (!has_normals_) mesh_.normals.clear(), mesh_.normal_triangles.clear();
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw Error("{}: {}", path_.string(), what); }

  template <typename T>
  const T& at(const std::vector<T>& items, int index, const char* what) const {
    if (index < 0 || index >= static_cast<int>(items.size()))
      fail(fmt::format("expected a {} index below {}, found {}", what, items.size(), index));
    return items[index];
  }

  bool is_child(int node) const {
    for (const tinygltf::Node& parent : model_.nodes)
      if (std::find(parent.children.begin(), parent.children.end(), node) != parent.children.end()) return true;
    return false;
  }

  static Eigen::Affine3d transform_of(const tinygltf::Node& node) {
    Eigen::Affine3d transform = Eigen::Affine3d::Identity();
    if (node.matrix.size() == 16) {
      transform.matrix() = Eigen::Map<const Eigen::Matrix4d>(node.matrix.data());
      return transform;
    }
    const auto& t = node.translation;
    const auto& r = node.rotation;
    const auto& s = node.scale;
    if (t.size() == 3) transform.translate(Eigen::Vector3d(t[0], t[1], t[2]));
    if (r.size() == 4) transform.rotate(Eigen::Quaterniond(r[3], r[0], r[1], r[2]).normalized());
    if (s.size() == 3) transform.scale(Eigen::Vector3d(s[0], s[1], s[2]));
    return transform;
  }

  void add_node(int index, const Eigen::Affine3d& parent, int depth) {
    if (depth > kDeepestNode) fail(fmt::format("expected nodes at most {} deep, found a cycle or more", kDeepestNode));
    const tinygltf::Node& node = at(model_.nodes, index, "node");
    const Eigen::Affine3d to_world = parent * transform_of(node);
    if (node.mesh >= 0) {
      const tinygltf::Mesh& mesh = at(model_.meshes, node.mesh, "mesh");
      group_ = node.name.empty() ? mesh.name : node.name;
      for (const tinygltf::Primitive& primitive : mesh.primitives) add_primitive(primitive, to_world);
    }
    for (const int child : node.children) add_node(child, to_world, depth + 1);
  }

  /// An accessor's bytes, checked against its buffer view and buffer.
  struct Values {
    const unsigned char* data;
    std::size_t count, stride;
    int component;
    bool normalized;
  };

  Values values_of(int accessor_index, int components) const {
    const tinygltf::Accessor& accessor = at(model_.accessors, accessor_index, "accessor");
    const tinygltf::BufferView& view = at(model_.bufferViews, accessor.bufferView, "buffer view");
    const std::vector<unsigned char>& bytes = at(model_.buffers, view.buffer, "buffer").data;
    if (tinygltf::GetNumComponentsInType(accessor.type) != components)
      fail(
          fmt::format("accessor {}: expected {} components, found type {}", accessor_index, components, accessor.type));
    const int stride = accessor.ByteStride(view);
    const int component_bytes = tinygltf::GetComponentSizeInBytes(accessor.componentType);
    if (stride <= 0 || component_bytes <= 0)
      fail(fmt::format("accessor {}: unknown component type or stride", accessor_index));
    const std::size_t element = std::size_t(component_bytes) * components, step = stride;
    const std::size_t start = view.byteOffset + accessor.byteOffset;
    // Divisions, so that absurd counts cannot overflow.
    if (start > bytes.size() || (accessor.count > 0 && (bytes.size() - start < element ||
                                                        accessor.count - 1 > (bytes.size() - start - element) / step)))
      fail(fmt::format("accessor {}: expected {} elements, found a buffer of {} bytes", accessor_index, accessor.count,
                       bytes.size()));
    return {bytes.data() + start, accessor.count, step, accessor.componentType, accessor.normalized};
  }

  template <typename T>
  static T read(const Values& values, std::size_t i, int component) {
    T value;
    std::memcpy(&value, values.data + i * values.stride + component * sizeof(T), sizeof(T));
    return value;
  }

  /// Whole numbers (KHR_mesh_quantization) are themselves, or parts of the largest one where they are normalized.
  template <typename T>
  static float whole_at(const Values& values, std::size_t i, int component) {
    const auto value = static_cast<float>(read<T>(values, i, component));
    return values.normalized ? std::max(-1.0f, value / static_cast<float>(std::numeric_limits<T>::max())) : value;
  }

  float float_at(const Values& values, std::size_t i, int component) const {
    switch (values.component) {
      case TINYGLTF_COMPONENT_TYPE_FLOAT:
        return read<float>(values, i, component);
      case TINYGLTF_COMPONENT_TYPE_BYTE:
        return whole_at<std::int8_t>(values, i, component);
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return whole_at<std::uint8_t>(values, i, component);
      case TINYGLTF_COMPONENT_TYPE_SHORT:
        return whole_at<std::int16_t>(values, i, component);
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return whole_at<std::uint16_t>(values, i, component);
      default:
        fail(fmt::format("expected float attributes, found component type {}", values.component));
    }
  }

  std::uint32_t index_at(const Values& values, std::size_t i) const {
    switch (values.component) {
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return read<std::uint8_t>(values, i, 0);
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return read<std::uint16_t>(values, i, 0);
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        return read<std::uint32_t>(values, i, 0);
      default:
        fail(fmt::format("expected unsigned indices, found component type {}", values.component));
    }
  }

  std::optional<Values> attribute(const tinygltf::Primitive& primitive, const std::string& name, int components) const {
    const auto found = primitive.attributes.find(name);
    if (found == primitive.attributes.end()) return std::nullopt;
    return values_of(found->second, components);
  }

  void add_primitive(const tinygltf::Primitive& primitive, const Eigen::Affine3d& to_world) {
    const int mode = primitive.mode == -1 ? TINYGLTF_MODE_TRIANGLES : primitive.mode;
    if (mode < TINYGLTF_MODE_POINTS || mode > TINYGLTF_MODE_TRIANGLE_FAN)
      fail(fmt::format("expected a primitive mode from 0 to 6, found {}", mode));
    // Points and lines are no surface.
    if (mode < TINYGLTF_MODE_TRIANGLES) return;
    const auto draco = primitive.extensions.find("KHR_draco_mesh_compression");
    const GltfPrimitive data =
        draco == primitive.extensions.end() ? read_accessors(primitive, mode) : read_draco(draco->second);
    for (const std::uint32_t corner : data.corners)
      if (corner >= data.positions.size())
        fail(fmt::format("expected a vertex index below {}, found {}", data.positions.size(), corner));
    has_normals_ &= !data.normals.empty(), has_uv_ &= !data.uv.empty();
    add_part(primitive);
    add_triangles(data, to_world.linear().determinant() < 0);
    add_vertices(data, to_world);
  }

  GltfPrimitive read_accessors(const tinygltf::Primitive& primitive, int mode) const {
    GltfPrimitive data;
    const std::optional<Values> positions = attribute(primitive, "POSITION", 3);
    if (!positions) fail("expected a primitive with POSITION, found one without");
    const std::optional<Values> normals = attribute(primitive, "NORMAL", 3);
    const std::optional<Values> uv = attribute(primitive, uv_name_, 2);
    if ((normals && normals->count != positions->count) || (uv && uv->count != positions->count))
      fail(fmt::format("expected {} normals and uv as there are positions, found {} and {}", positions->count,
                       normals ? normals->count : 0, uv ? uv->count : 0));
    const auto vec3_at = [&](const Values& values, std::size_t i) {
      return Vec3{float_at(values, i, 0), float_at(values, i, 1), float_at(values, i, 2)};
    };
    for (std::size_t i = 0; i < positions->count; ++i) {
      data.positions.push_back(vec3_at(*positions, i));
      if (normals) data.normals.push_back(vec3_at(*normals, i));
      if (uv) data.uv.push_back({float_at(*uv, i, 0), float_at(*uv, i, 1)});
    }
    data.corners = corners_of(primitive, mode, positions->count);
    return data;
  }

  /// Strips and fans are unrolled.
  std::vector<std::uint32_t> corners_of(const tinygltf::Primitive& primitive, int mode, std::size_t vertices) const {
    std::optional<Values> indices;
    if (primitive.indices >= 0) indices = values_of(primitive.indices, 1);
    const std::size_t count = indices ? indices->count : vertices;
    const auto corner = [&](std::size_t i) { return indices ? index_at(*indices, i) : static_cast<std::uint32_t>(i); };
    std::vector<std::uint32_t> corners;
    if (mode == TINYGLTF_MODE_TRIANGLES) {
      if (count % 3 != 0) fail(fmt::format("expected whole triangles, found {} corners", count));
      for (std::size_t i = 0; i < count; ++i) corners.push_back(corner(i));
      return corners;
    }
    for (std::size_t i = 2; i < count; ++i) {
      const bool is_strip = mode == TINYGLTF_MODE_TRIANGLE_STRIP, turned = is_strip && i % 2 == 1;
      const std::uint32_t before = corner(i - 1), first = is_strip ? corner(i - 2) : corner(0);
      corners.insert(corners.end(), {turned ? before : first, turned ? first : before, corner(i)});
    }
    return corners;
  }

  GltfPrimitive read_draco(const tinygltf::Value& extension) const {
    const tinygltf::Value &view_index = extension.Get("bufferView"), &names = extension.Get("attributes");
    if (!view_index.IsInt() || !names.IsObject() || !names.Get("POSITION").IsInt())
      fail("expected Draco compression with bufferView and POSITION, found none");
    const tinygltf::BufferView& view = at(model_.bufferViews, view_index.GetNumberAsInt(), "buffer view");
    const std::vector<unsigned char>& bytes = at(model_.buffers, view.buffer, "buffer").data;
    if (view.byteOffset > bytes.size() || view.byteLength > bytes.size() - view.byteOffset)
      fail(fmt::format("expected {} bytes of Draco compression, found a buffer of {} bytes", view.byteLength,
                       bytes.size()));
    const auto number = [&](const std::string& name) -> std::optional<std::uint32_t> {
      const tinygltf::Value& value = names.Get(name);
      if (!value.IsInt()) return std::nullopt;
      return static_cast<std::uint32_t>(value.GetNumberAsInt());
    };
    try {
      return decode_draco(std::span(bytes).subspan(view.byteOffset, view.byteLength),
                          {*number("POSITION"), number("NORMAL"), number(uv_name_)});
    } catch (const Error& error) {
      fail(error.what());
    }
  }

  /// Nodes are groups: what people see in a modelling program.
  void add_part(const tinygltf::Primitive& primitive) {
    const bool has_material = primitive.material >= 0;
    mesh_.parts.push_back({group_, has_material ? at(model_.materials, primitive.material, "material").name : ""});
  }

  /// A mirroring transform turns the winding, so turn it back.
  void add_triangles(const GltfPrimitive& data, bool mirrored) {
    const auto first = static_cast<std::uint32_t>(mesh_.positions.size());
    for (std::size_t i = 0; i + 2 < data.corners.size(); i += 3) {
      Triangle triangle = {first + data.corners[i], first + data.corners[i + 1], first + data.corners[i + 2]};
      if (mirrored) std::swap(triangle[1], triangle[2]);
      mesh_.triangles.push_back(triangle);
      mesh_.normal_triangles.push_back(triangle);
      mesh_.uv_triangles.push_back(triangle);
      mesh_.triangle_parts.push_back(static_cast<std::uint32_t>(mesh_.parts.size() - 1));
    }
  }

  void add_vertices(const GltfPrimitive& data, const Eigen::Affine3d& to_world) {
    const Eigen::Matrix3d normal_to_world = to_world.linear().inverse().transpose();
    const auto to_eigen = [](Vec3 v) { return Eigen::Vector3d(v.x, v.y, v.z); };
    const auto to_vec3 = [](const Eigen::Vector3d& v) {
      return Vec3{static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
    };
    for (std::size_t i = 0; i < data.positions.size(); ++i) {
      mesh_.positions.push_back(to_vec3(to_world * to_eigen(data.positions[i])));
      mesh_.normals.push_back(
          data.normals.empty() ? Vec3{} : to_vec3((normal_to_world * to_eigen(data.normals[i])).normalized()));
      // glTF counts v downwards from the top of the picture.
      mesh_.uv.push_back(data.uv.empty() ? Vec2{} : Vec2{data.uv[i].x, 1 - data.uv[i].y});
    }
  }

  const std::filesystem::path& path_;
  const tinygltf::Model& model_;
  const std::string uv_name_;
  std::string group_;  // the node whose mesh is being read
  TriangleMesh mesh_;
  bool has_uv_ = true, has_normals_ = true;
};

/// What would deform the mesh.
void note_deformers(const std::filesystem::path& path, const tinygltf::Model& model,
                    std::vector<std::string>& not_applied) {
  const auto skinned = std::count_if(model.nodes.begin(), model.nodes.end(),
                                     [](const tinygltf::Node& n) { return n.mesh >= 0 && n.skin >= 0; });
  const auto has_targets = [](const tinygltf::Primitive& p) { return !p.targets.empty(); };
  const auto morphed = std::count_if(model.meshes.begin(), model.meshes.end(), [&](const tinygltf::Mesh& m) {
    return std::any_of(m.primitives.begin(), m.primitives.end(), has_targets);
  });
  const std::string name = path.filename().string();
  if (skinned > 0)
    not_applied.push_back(
        fmt::format("{}: the skins of {} nodes are not applied: read as it is stored", name, skinned));
  if (morphed > 0)
    not_applied.push_back(
        fmt::format("{}: the morphs of {} meshes are not applied: read as it is stored", name, morphed));
}

}  // namespace

TriangleMesh read_gltf(const std::filesystem::path& path, bool binary, int uv_set,
                       std::vector<std::string>& not_applied) {
  tinygltf::Model model = load_gltf(path, binary);
  fill_sparse_accessors(path, model);
  for (const std::string& extension : model.extensionsRequired)
    if (std::find(std::begin(kKnownExtensions), std::end(kKnownExtensions), extension) == std::end(kKnownExtensions) &&
        !extension.starts_with("KHR_materials_") && !extension.starts_with("KHR_technique"))
      throw Error("{}: expected glTF 2.0 with extensions that redmap knows, found that it requires {}", path.string(),
                  extension);
  TriangleMesh mesh = GltfMesh(path, model, uv_set).read();
  note_deformers(path, model, not_applied);
  return mesh;
}

}  // namespace redmap
