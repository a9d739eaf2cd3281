#include "gpu/bake_kernels.h"

#include <algorithm>
#include <cstring>

#include "device/glsl_compiler.h"

namespace redmap {
namespace {

/// No batch of a shader whose loops end takes that long. A device's own watchdog may end it sooner.
constexpr std::chrono::minutes kTimeout{2};

/// As bake_text.h says.
struct PackedPlace {
  Vec3 position;
  float u;
  Vec3 normal;
  float v;
  Vec3 tangent;
  float unused;
};
static_assert(sizeof(PackedPlace) == 12 * sizeof(float));

DeviceShader require_device_shader(const Shader& shader) {
  if (std::optional<DeviceShader> found = device_shader(shader)) return std::move(*found);
  throw Error("shader \"{}\": expected a text in GLSL to bake on a device, found none", shader.info().name);
}

template <typename Value>
DeviceBuffer make_buffer(const Device& device, std::span<const Value> values) {
  DeviceBuffer buffer(device, values.size_bytes());
  std::memcpy(buffer.data(), values.data(), values.size_bytes());
  return buffer;
}

}  // namespace

BakeKernels::BakeKernels(const Shader& shader, const std::string& device)
    : device_(Device::open(device)),
      info_(shader.info()),
      shader_(require_device_shader(shader)),
      parameters_(make_buffer(*device_, std::span<const std::byte>(shader_.parameters))) {
  for (const Image& image : shader_.images) images_.emplace_back(*device_, image);
}

ComputePipeline BakeKernels::compile(const ShaderSources& text) const {
  // The library's texts are known to end.
  const std::vector<std::uint32_t> spirv =
      compile_glsl(text.text, text.names, info_.file.empty() ? "" : kBakeLoopGuard);
  return {*device_, spirv, {kBakeBuffers, static_cast<int>(images_.size()), sizeof(BakeCall), 1}};
}

ComputePipeline BakeKernels::keys(const SampledTexels& sampled) const {
  return compile(key_text(shader_, info_, sampled));
}

ComputePipeline BakeKernels::weights(const SampledTexels& sampled, const ChosenBasis& basis) const {
  return compile(weight_text(shader_, info_, sampled, basis, device_->has_doubles()));
}

PointBatch::PointBatch(const BakeKernels& kernels, const ComputePipeline& pipeline, const DeviceBuffer& known,
                       std::size_t most_points, std::size_t out_words_per_point)
    : places_(*kernels.device(), most_points * sizeof(PackedPlace)),
      first_buffer_(*kernels.device(), (most_points + 1) * sizeof(std::uint32_t)),
      out_(*kernels.device(), most_points * out_words_per_point * sizeof(std::uint32_t)),
      status_(*kernels.device(), sizeof(std::uint32_t)),
      task_(pipeline) {
  task_.bind(kBakePlaces, places_), task_.bind(kBakeKnown, known);
  task_.bind(kBakeFirst, first_buffer_), task_.bind(kBakeOut, out_), task_.bind(kBakeStatus, status_);
  int binding = kBakeBuffers;
  for (const DeviceImage& image : kernels.images()) task_.bind(binding++, image);
  task_.bind(binding, kernels.parameters());
}

void PointBatch::add(const SurfacePoints& points, std::span<const std::size_t> texel) {
  auto* places = reinterpret_cast<PackedPlace*>(places_.data()) + points_;
  for (std::size_t i = 0; i < points.size(); ++i)
    places[i] = {points.position.get(i), points.uv[0][i],       points.normal.get(i),
                 points.uv[1][i],        points.tangent.get(i), 0};
  time_ = points.time;
  for (std::size_t i = 0; i < texel.size(); ++i)
    if (i == 0 || texel[i] != texel[i - 1]) {
      texels_.push_back(texel[i]);
      first_.push_back(static_cast<std::uint32_t>(points_ + i));
    }
  points_ += points.size();
}

std::optional<std::size_t> PointBatch::run(BakeCall call) {
  if (call.count == 0) return std::nullopt;
  call.time = time_;
  auto* first = reinterpret_cast<std::uint32_t*>(first_buffer_.data());
  *std::copy(first_.begin(), first_.end(), first) = static_cast<std::uint32_t>(points_);
  std::memcpy(status_.data(), &kNothingWrong, sizeof kNothingWrong);
  task_.run(std::as_bytes(std::span(&call, 1)), {(call.count + kBakeGroup - 1) / kBakeGroup, 1}, kTimeout);
  std::uint32_t status = 0;
  std::memcpy(&status, status_.data(), sizeof status);
  return status == kNothingWrong ? std::nullopt : std::optional<std::size_t>(status);
}

ReflectancePlace PointBatch::place(std::size_t i) const {
  const PackedPlace& place = reinterpret_cast<const PackedPlace*>(places_.data())[i];
  return {place.position, place.normal, place.tangent, {place.u, place.v}};
}

SurfacePoints PointBatch::point(std::size_t i) const {
  SurfacePoints point = points_at(std::vector{place(i)});
  point.time = time_;
  return point;
}

}  // namespace redmap
