// glTF 2.0 and GLB through tinygltf: the triangles of every mesh a node of the scene places, in world space, v upwards.
#include <tiny_gltf.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>

#include "base/error.h"
#include "surface/mesh_files.h"

namespace redmap {

namespace {

/// Deeper than any sound scene; a cycle of nodes ends here.
constexpr int kDeepestNode = 256;

class GltfMesh {
 public:
  GltfMesh(const std::filesystem::path& path, const tinygltf::Model& model) : path_(path), model_(model) {}

  TriangleMesh read() {
    if (model_.scenes.empty()) {
      for (int node = 0; node < static_cast<int>(model_.nodes.size()); ++node)
        if (!is_child(node)) add_node(node, Eigen::Affine3d::Identity(), 0);
    } else {
      const int scene = model_.defaultScene < 0 ? 0 : model_.defaultScene;
      for (const int node : at(model_.scenes, scene, "scene").nodes) add_node(node, Eigen::Affine3d::Identity(), 0);
    }
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
    if (node.mesh >= 0)
      for (const tinygltf::Primitive& primitive : at(model_.meshes, node.mesh, "mesh").primitives)
        add_primitive(primitive, to_world);
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
    if (accessor.sparse.isSparse) fail(fmt::format("accessor {}: sparse accessors are not supported", accessor_index));
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

  float float_at(const Values& values, std::size_t i, int component) const {
    switch (values.component) {
      case TINYGLTF_COMPONENT_TYPE_FLOAT:
        return read<float>(values, i, component);
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return read<std::uint8_t>(values, i, component) / 255.0f;
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return read<std::uint16_t>(values, i, component) / 65535.0f;
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

  std::optional<Values> attribute(const tinygltf::Primitive& primitive, const char* name, int components) const {
    const auto found = primitive.attributes.find(name);
    if (found == primitive.attributes.end()) return std::nullopt;
    return values_of(found->second, components);
  }

  void add_primitive(const tinygltf::Primitive& primitive, const Eigen::Affine3d& to_world) {
    if (primitive.mode != TINYGLTF_MODE_TRIANGLES && primitive.mode != -1)
      fail(fmt::format("expected primitives of triangles (mode 4), found mode {}", primitive.mode));
    if (primitive.extensions.contains("KHR_draco_mesh_compression")) fail("Draco compression is not supported");
    const std::optional<Values> positions = attribute(primitive, "POSITION", 3);
    if (!positions) fail("expected a primitive with POSITION, found one without");
    const std::optional<Values> normals = attribute(primitive, "NORMAL", 3), uv = attribute(primitive, "TEXCOORD_0", 2);
    has_normals_ &= normals.has_value(), has_uv_ &= uv.has_value();
    if ((normals && normals->count != positions->count) || (uv && uv->count != positions->count))
      fail(fmt::format("expected {} normals and uv as there are positions, found {} and {}", positions->count,
                       normals ? normals->count : 0, uv ? uv->count : 0));
    add_triangles(primitive, positions->count, to_world.linear().determinant() < 0);
    add_vertices(*positions, normals, uv, to_world);
  }

  /// A mirroring transform turns the winding, so turn it back.
  void add_triangles(const tinygltf::Primitive& primitive, std::size_t vertices, bool mirrored) {
    const auto first = static_cast<std::uint32_t>(mesh_.positions.size());
    std::optional<Values> indices;
    if (primitive.indices >= 0) indices = values_of(primitive.indices, 1);
    const std::size_t corners = indices ? indices->count : vertices;
    if (corners % 3 != 0) fail(fmt::format("expected whole triangles, found {} corners", corners));
    for (std::size_t i = 0; i < corners; i += 3) {
      Triangle triangle;
      for (int k = 0; k < 3; ++k) {
        const std::uint32_t index = indices ? index_at(*indices, i + k) : static_cast<std::uint32_t>(i + k);
        if (index >= vertices) fail(fmt::format("expected a vertex index below {}, found {}", vertices, index));
        triangle[k] = first + index;
      }
      if (mirrored) std::swap(triangle[1], triangle[2]);
      mesh_.triangles.push_back(triangle);
      mesh_.normal_triangles.push_back(triangle);
      mesh_.uv_triangles.push_back(triangle);
    }
  }

  void add_vertices(const Values& positions, const std::optional<Values>& normals, const std::optional<Values>& uv,
                    const Eigen::Affine3d& to_world) {
    const Eigen::Matrix3d normal_to_world = to_world.linear().inverse().transpose();
    const auto vector_at = [&](const Values& values, std::size_t i) {
      return Eigen::Vector3d(float_at(values, i, 0), float_at(values, i, 1), float_at(values, i, 2));
    };
    const auto to_vec3 = [](const Eigen::Vector3d& v) {
      return Vec3{static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
    };
    for (std::size_t i = 0; i < positions.count; ++i) {
      mesh_.positions.push_back(to_vec3(to_world * vector_at(positions, i)));
      mesh_.normals.push_back(normals ? to_vec3((normal_to_world * vector_at(*normals, i)).normalized()) : Vec3{});
      // glTF counts v downwards from the top of the picture.
      mesh_.uv.push_back(uv ? Vec2{float_at(*uv, i, 0), 1 - float_at(*uv, i, 1)} : Vec2{});
    }
  }

  const std::filesystem::path& path_;
  const tinygltf::Model& model_;
  TriangleMesh mesh_;
  bool has_uv_ = true, has_normals_ = true;
};

/// Pictures are no part of a mesh: left unread.
bool skip_image(tinygltf::Image*, const int, std::string*, std::string*, int, int, const unsigned char*, int, void*) {
  return true;
}

}  // namespace

TriangleMesh read_gltf(const std::filesystem::path& path, bool binary) {
  const std::string bytes = read_bytes(path);
  tinygltf::TinyGLTF loader;
  loader.SetImageLoader(skip_image, nullptr);
  tinygltf::Model model;
  std::string error, warning;
  const std::string folder = path.parent_path().string();
  const auto size = static_cast<unsigned int>(bytes.size());
  const bool sound =
      binary ? loader.LoadBinaryFromMemory(&model, &error, &warning,
                                           reinterpret_cast<const unsigned char*>(bytes.data()), size, folder)
             : loader.LoadASCIIFromString(&model, &error, &warning, bytes.data(), size, folder);
  if (!sound) {
    std::replace(error.begin(), error.end(), '\n', ' ');
    throw Error("{}: expected sound glTF, found: {}", path.string(), error.empty() ? "something else" : error);
  }
  return GltfMesh(path, model).read();
}

}  // namespace redmap
