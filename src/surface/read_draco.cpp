// Draco meshes (KHR_draco_mesh_compression) through Google's library.
#include <draco/compression/decode.h>

#include "base/error.h"
#include "surface/gltf_primitive.h"

namespace redmap {

namespace {

/// One attribute of every point, `Components` floats each; integers are taken as they are.
template <int Components, typename Vector>
std::vector<Vector> values_of(const draco::Mesh& mesh, std::uint32_t id, const char* name) {
  const draco::PointAttribute* attribute = mesh.GetAttributeByUniqueId(id);
  if (!attribute || attribute->num_components() != Components)
    throw Error("Draco: expected attribute {} as {} with {} components, found none", id, name, Components);
  std::vector<Vector> values(mesh.num_points());
  for (std::uint32_t i = 0; i < values.size(); ++i) {
    std::array<float, Components> value;
    const draco::AttributeValueIndex index = attribute->mapped_index(draco::PointIndex(i));
    if (index.value() >= attribute->size() || !attribute->ConvertValue<float, Components>(index, value.data()))
      throw Error("Draco: expected {} of point {} as numbers, found something else", name, i);
    if constexpr (Components == 3)
      values[i] = {value[0], value[1], value[2]};
    else
      values[i] = {value[0], value[1]};
  }
  return values;
}

}  // namespace

GltfPrimitive decode_draco(std::span<const unsigned char> bytes, const DracoAttributes& attributes) {
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  draco::Decoder decoder;
  auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
  if (!decoded.ok())
    throw Error("expected a Draco mesh of {} bytes, found: {}", bytes.size(), decoded.status().error_msg_string());
  const draco::Mesh& mesh = *decoded.value();

  GltfPrimitive primitive;
  primitive.positions = values_of<3, Vec3>(mesh, attributes.position, "POSITION");
  if (attributes.normal) primitive.normals = values_of<3, Vec3>(mesh, *attributes.normal, "NORMAL");
  if (attributes.uv) primitive.uv = values_of<2, Vec2>(mesh, *attributes.uv, "TEXCOORD");
  for (std::uint32_t f = 0; f < mesh.num_faces(); ++f)
    for (const draco::PointIndex& corner : mesh.face(draco::FaceIndex(f))) primitive.corners.push_back(corner.value());
  return primitive;
}

}  // namespace redmap
