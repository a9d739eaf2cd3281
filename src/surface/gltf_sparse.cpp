// Sparse accessors (glTF 2.0, section 3.6.2.3): some elements replaced in zeros or in another buffer.
#include <algorithm>
#include <cstring>

#include "base/error.h"
#include "surface/gltf_document.h"

namespace redmap {

namespace {

class SparseFiller {
 public:
  SparseFiller(const std::filesystem::path& path, tinygltf::Model& model) : path_(path), model_(model) {}

  void run() {
    for (std::size_t i = 0; i < model_.accessors.size(); ++i)
      if (model_.accessors[i].sparse.isSparse) fill(i);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw Error("{}: accessor {}: {}", path_.string(), accessor_, what);
  }

  /// `count` elements of `element` bytes, `stride` apart, from `offset` of a buffer view on.
  const unsigned char* bytes(int view_index, std::size_t offset, std::size_t count, std::size_t element,
                             std::size_t stride) const {
    if (view_index < 0 || view_index >= static_cast<int>(model_.bufferViews.size()))
      fail(fmt::format("expected a buffer view index below {}, found {}", model_.bufferViews.size(), view_index));
    const tinygltf::BufferView& view = model_.bufferViews[view_index];
    if (view.buffer < 0 || view.buffer >= static_cast<int>(model_.buffers.size()))
      fail(fmt::format("expected a buffer index below {}, found {}", model_.buffers.size(), view.buffer));
    const std::vector<unsigned char>& data = model_.buffers[view.buffer].data;
    const std::size_t size = data.size();
    // Step by step, so that absurd numbers cannot overflow.
    const bool starts = view.byteOffset <= size && offset <= size - view.byteOffset;
    const std::size_t rest = starts ? size - view.byteOffset - offset : 0;
    if (!starts || (count > 0 && (rest < element || count - 1 > (rest - element) / stride)))
      fail(fmt::format("expected {} elements of {} bytes, found a buffer of {} bytes", count, element, size));
    return data.data() + view.byteOffset + offset;
  }

  std::size_t index(const unsigned char* from, int component, std::size_t i) const {
    const auto read = [&](auto value) {
      std::memcpy(&value, from + i * sizeof value, sizeof value);
      return static_cast<std::size_t>(value);
    };
    if (component == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE) return read(std::uint8_t{});
    if (component == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT) return read(std::uint16_t{});
    return read(std::uint32_t{});
  }

  void fill(std::size_t i) {
    accessor_ = i;
    tinygltf::Accessor& accessor = model_.accessors[i];
    const auto& sparse = accessor.sparse;
    const int component = tinygltf::GetComponentSizeInBytes(accessor.componentType);
    const int components = tinygltf::GetNumComponentsInType(accessor.type);
    const int index_bytes = tinygltf::GetComponentSizeInBytes(sparse.indices.componentType);
    const bool is_index = sparse.indices.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
                          sparse.indices.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
                          sparse.indices.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
    if (component <= 0 || components <= 0 || !is_index) fail("expected known component types");
    // More elements than any file that was seen, and few enough to fit the memory.
    constexpr std::size_t kMost = std::size_t{1} << 28;
    if (accessor.count > kMost || sparse.count < 0 || static_cast<std::size_t>(sparse.count) > accessor.count)
      fail(fmt::format("expected up to {} elements and no more replacements, found {} and {}", kMost, accessor.count,
                       sparse.count));

    const std::size_t element = static_cast<std::size_t>(component) * components, replaced = sparse.count;
    const unsigned char* indices =
        bytes(sparse.indices.bufferView, sparse.indices.byteOffset, replaced, index_bytes, index_bytes);
    const unsigned char* values = bytes(sparse.values.bufferView, sparse.values.byteOffset, replaced, element, element);
    std::vector<unsigned char> filled = base_values(accessor, element);
    for (std::size_t k = 0; k < replaced; ++k) {
      const std::size_t at = index(indices, sparse.indices.componentType, k);
      if (at >= accessor.count) fail(fmt::format("expected sparse indices below {}, found {}", accessor.count, at));
      std::memcpy(filled.data() + at * element, values + k * element, element);
    }
    point_at(std::move(filled), accessor);
  }

  /// Before replacement: zeros where there is no buffer view.
  std::vector<unsigned char> base_values(const tinygltf::Accessor& accessor, std::size_t element) const {
    std::vector<unsigned char> values(accessor.count * element);
    if (accessor.bufferView < 0) return values;
    bytes(accessor.bufferView, 0, 0, 0, 1);
    const int stride = accessor.ByteStride(model_.bufferViews[accessor.bufferView]);
    if (stride <= 0) fail("expected a stride above 0");
    const unsigned char* from = bytes(accessor.bufferView, accessor.byteOffset, accessor.count, element, stride);
    for (std::size_t k = 0; k < accessor.count; ++k) std::memcpy(&values[k * element], from + k * stride, element);
    return values;
  }

  void point_at(std::vector<unsigned char> values, tinygltf::Accessor& accessor) {
    tinygltf::BufferView view;
    view.buffer = static_cast<int>(model_.buffers.size());
    view.byteLength = values.size();
    accessor.bufferView = static_cast<int>(model_.bufferViews.size());
    accessor.byteOffset = 0;
    accessor.sparse.isSparse = false;
    model_.buffers.emplace_back().data = std::move(values);
    model_.bufferViews.push_back(view);
  }

  const std::filesystem::path& path_;
  tinygltf::Model& model_;
  std::size_t accessor_ = 0;
};

}  // namespace

void fill_sparse_accessors(const std::filesystem::path& path, tinygltf::Model& model) {
  SparseFiller(path, model).run();
}

}  // namespace redmap
