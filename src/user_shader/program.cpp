#include "user_shader/program.h"

#include <cstring>

#include "device/glsl_compiler.h"

namespace redmap {
namespace {

/// No dispatch of a shader whose loops end takes that long. A device's own watchdog may end it sooner.
constexpr std::chrono::minutes kTimeout{2};

PipelineInputs inputs(std::size_t images) { return {kStageBuffers, static_cast<int>(images), sizeof(StageCall)}; }

}  // namespace

/// What one thread needs at a time: buffers that grow with the batches, and a task a stage.
struct ShaderProgram::Workspace {
  std::array<std::unique_ptr<DeviceBuffer>, kStageBuffers> buffers;
  std::array<std::unique_ptr<ComputeTask>, kStages> tasks;

  DeviceBuffer& buffer(const Device& device, StageBuffer which, std::size_t size) {
    std::unique_ptr<DeviceBuffer>& kept = buffers[which];
    if (!kept || kept->size() < size) kept = std::make_unique<DeviceBuffer>(device, size);
    return *kept;
  }
};

struct ShaderProgram::OnDevice {
  std::shared_ptr<Device> device;
  std::vector<DeviceImage> images;
  std::mutex mutex;
  std::array<std::unique_ptr<ComputePipeline>, kStages> pipelines;  ///< made when first asked for: many need but one
  std::vector<std::unique_ptr<Workspace>> idle;
};

/// A workspace for as long as it lives.
class ShaderProgram::Lease {
 public:
  explicit Lease(OnDevice& owner) : owner_(owner) {
    const std::scoped_lock lock(owner_.mutex);
    if (owner_.idle.empty()) {
      workspace_ = std::make_unique<Workspace>();
    } else {
      workspace_ = std::move(owner_.idle.back());
      owner_.idle.pop_back();
    }
  }
  ~Lease() {
    const std::scoped_lock lock(owner_.mutex);
    owner_.idle.push_back(std::move(workspace_));
  }
  Lease(const Lease&) = delete;
  Lease& operator=(const Lease&) = delete;
  Workspace& operator*() { return *workspace_; }

 private:
  OnDevice& owner_;
  std::unique_ptr<Workspace> workspace_;
};

ShaderProgram::ShaderProgram(std::vector<std::uint32_t> spirv, std::vector<std::byte> parameters,
                             std::vector<Image> images, std::string device)
    : spirv_(std::move(spirv)),
      parameters_(std::move(parameters)),
      images_(std::move(images)),
      device_(std::move(device)),
      pattern_size_(array_stride(spirv_, kPatternBlock)) {}

ShaderProgram::~ShaderProgram() = default;

ShaderProgram::OnDevice& ShaderProgram::on_device() const {
  const std::scoped_lock lock(mutex_);
  if (on_device_) return *on_device_;
  auto made = std::make_unique<OnDevice>();
  made->device = Device::open(device_);
  for (const Image& image : images_) made->images.emplace_back(*made->device, image);
  on_device_ = std::move(made);
  return *on_device_;
}

ComputePipeline& ShaderProgram::pipeline(OnDevice& on, Stage stage) const {
  const std::scoped_lock lock(on.mutex);
  std::unique_ptr<ComputePipeline>& made = on.pipelines[static_cast<std::size_t>(stage)];
  if (!made)
    made = std::make_unique<ComputePipeline>(*on.device, spirv_, inputs(images_.size()),
                                             static_cast<std::uint32_t>(stage));
  return *made;
}

void ShaderProgram::run(Stage stage, StageCall call, const InputRows& in, std::span<std::byte> patterns,
                        std::span<float* const> out) const {
  OnDevice& on = on_device();
  call.in_stride = static_cast<std::uint32_t>(in.count);
  // A CPU reads a pattern once for all pairs; a GPU is better off with more invocations.
  if (on.device->info().software && !one_pair_each_) call.pairs_each = call.pairs;
  std::uint32_t status = dispatch(on, stage, call, in, patterns, out);
  if (status != kAllEnded && call.pairs_each > 1) {
    // All pairs together may just have been too many.
    one_pair_each_ = true;
    call.pairs_each = 1;
    status = dispatch(on, stage, call, in, patterns, out);
  }
  if (status != kAllEnded)
    throw FunctionError(status / kStatusFunctions, status_function(status % kStatusFunctions),
                        fmt::format("expected loops that end within {} rounds in all, found more", kMostRounds));
}

std::uint32_t ShaderProgram::dispatch(OnDevice& on, Stage stage, const StageCall& call, const InputRows& in,
                                      std::span<std::byte> patterns, std::span<float* const> out) const {
  Lease lease(on);
  Workspace& workspace = *lease;
  std::unique_ptr<ComputeTask>& task = workspace.tasks[static_cast<std::size_t>(stage)];
  if (!task) task = std::make_unique<ComputeTask>(pipeline(on, stage));

  const std::size_t row_bytes = call.places * sizeof(float), in_bytes = in.count * sizeof(float);
  const std::size_t sizes[kStageBuffers] = {parameters_.size(), in.rows.size() * in_bytes, patterns.size(),
                                            out.size() * row_bytes, sizeof kAllEnded};
  for (int b = 0; b < kStageBuffers; ++b)
    task->bind(b, workspace.buffer(*on.device, static_cast<StageBuffer>(b), sizes[b]));
  for (std::size_t i = 0; i < on.images.size(); ++i) task->bind(static_cast<int>(kStageBuffers + i), on.images[i]);

  // In: parameters, rows, patterns.
  const auto data = [&](StageBuffer which) { return workspace.buffers[which]->data(); };
  std::memcpy(data(kParameterBuffer), parameters_.data(), parameters_.size());
  for (std::size_t r = 0; r < in.rows.size(); ++r) std::memcpy(data(kInBuffer) + r * in_bytes, in.rows[r], in_bytes);
  if (stage != Stage::kBind) std::memcpy(data(kPatternBuffer), patterns.data(), patterns.size());
  std::memcpy(data(kStatusBuffer), &kAllEnded, sizeof kAllEnded);

  const std::uint32_t blocks = (call.pairs + call.pairs_each - 1) / call.pairs_each;
  const std::uint32_t groups = (call.places + kGroupSize - 1) / kGroupSize;
  task->run(std::as_bytes(std::span(&call, 1)), {groups, blocks}, kTimeout);

  std::uint32_t status = 0;
  std::memcpy(&status, data(kStatusBuffer), sizeof status);
  if (stage == Stage::kBind) std::memcpy(patterns.data(), data(kPatternBuffer), patterns.size());
  for (std::size_t r = 0; r < out.size(); ++r) std::memcpy(out[r], data(kOutBuffer) + r * row_bytes, row_bytes);
  return status;
}

}  // namespace redmap
