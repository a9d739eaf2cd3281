// A compiled user's shader on its device: runs the stages of stages.h on rows of floats. Not part of the public
// interface.
#pragma once

#include <array>
#include <atomic>
#include <mutex>
#include <span>

#include "base/image.h"
#include "device/device.h"
#include "user_shader/function_error.h"
#include "user_shader/stages.h"

namespace redmap {

/// What a stage reads: `rows[r]` has `count` floats.
struct InputRows {
  std::vector<const float*> rows;
  std::size_t count = 0;
};

class ShaderProgram {
 public:
  /// `parameters`: the struct Parameters, std430.
  ShaderProgram(std::vector<std::uint32_t> spirv, std::vector<std::byte> parameters, std::vector<Image> images,
                std::string device);
  ~ShaderProgram();

  /// Bytes a bound pattern takes.
  std::size_t pattern_size() const { return pattern_size_; }
  /// One dispatch. Strides and what follows from the rows are filled in. `patterns` are read, or written by
  /// Stage::kBind. Safe to call from several threads. Throws FunctionError on a function that does not end, Error where
  /// the device fails.
  void run(Stage stage, StageCall call, const InputRows& in, std::span<std::byte> patterns,
           std::span<float* const> out) const;

 private:
  struct Workspace;
  struct OnDevice;
  class Lease;
  OnDevice& on_device() const;
  ComputePipeline& pipeline(OnDevice& on, Stage stage) const;
  /// Returns the status (stages.h).
  std::uint32_t dispatch(OnDevice& on, Stage stage, const StageCall& call, const InputRows& in,
                         std::span<std::byte> patterns, std::span<float* const> out) const;

  std::vector<std::uint32_t> spirv_;
  std::vector<std::byte> parameters_;
  std::vector<Image> images_;
  std::string device_;
  std::size_t pattern_size_;
  mutable std::atomic<bool> one_pair_each_ = false;  ///< all pairs of a call in one invocation were too many
  mutable std::mutex mutex_;
  mutable std::unique_ptr<OnDevice> on_device_;  ///< made when the shader first runs
};

}  // namespace redmap
