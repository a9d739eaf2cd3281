#include "device/device.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <thread>

#include "device/glsl_compiler.h"

#ifdef __SANITIZE_ADDRESS__
#include <sanitizer/lsan_interface.h>
#endif

namespace redmap {
namespace {

using std::chrono::milliseconds;

/// Asked for before the first device is opened, whoever runs the tests.
[[maybe_unused]] const int kLayerAskedFor = setenv("VK_INSTANCE_LAYERS", "VK_LAYER_KHRONOS_validation", 0);

constexpr milliseconds kSoon{20000};
constexpr std::uint32_t kGroup = 64;

const std::string kHead = R"(#version 450
layout(local_size_x = 64) in;
layout(constant_id = 0) const uint stage = 0u;
layout(binding = 0, std430) buffer In { float a[]; };
layout(binding = 1, std430) buffer Out { float b[]; };
layout(push_constant) uniform Push { float factor; uint count; };
)";

std::vector<std::uint32_t> compile(const std::string& body) {
  const std::string names[] = {"test"};
  return compile_glsl(kHead + body, names);
}

const std::vector<std::uint32_t>& times_factor() {
  static const auto spirv =
      compile("void main() { uint i = gl_GlobalInvocationID.x; b[i] = a[i] * factor + float(stage); }");
  return spirv;
}

struct Push {
  float factor;
  std::uint32_t count;
};
constexpr PipelineInputs kInputs{2, 0, sizeof(Push)};

/// Runs `pipeline` on 0, 1, 2, ... and returns what it wrote.
std::vector<float> run(const Device& device, const ComputePipeline& pipeline, float factor, std::uint32_t count,
                       milliseconds timeout = kSoon) {
  DeviceBuffer in(device, count * sizeof(float)), out(device, count * sizeof(float));
  std::vector<float> values(count);
  for (std::uint32_t i = 0; i < count; ++i) values[i] = static_cast<float>(i);
  std::memcpy(in.data(), values.data(), in.size());
  std::memset(out.data(), 0, out.size());
  ComputeTask task(pipeline);
  task.bind(0, in), task.bind(1, out);
  const Push push{factor, count};
  task.run(std::as_bytes(std::span(&push, 1)), {count / kGroup}, timeout);
  std::memcpy(values.data(), out.data(), out.size());
  return values;
}

TEST(Device, OfThisMachineComputes) {
  ASSERT_FALSE(list_devices().empty());
  const auto device = Device::open();
  const ComputePipeline pipeline(*device, times_factor(), kInputs, 5);
  const std::vector<float> values = run(*device, pipeline, 2, 1024);
  for (std::size_t i = 0; i < values.size(); ++i) ASSERT_EQ(values[i], 2 * static_cast<float>(i) + 5);
}

TEST(Device, IsChosenByNumberOrPartOfItsName) {
  const DeviceInfo first = list_devices().front();
  EXPECT_FALSE(first.name.empty());
  EXPECT_EQ(Device::open("0")->info().name, first.name);
  std::string part = first.name.substr(1, 4);
  for (char& c : part) c = static_cast<char>(std::toupper(c));
  EXPECT_EQ(Device::open(part)->info().name, first.name);
}

TEST(Device, ThatIsNotThere_IsRefusedNamingThoseThatAre) {
  for (const char* choice : {"99", "-1", "no such thing", "0 "}) {
    try {
      Device::open(choice);
      ADD_FAILURE() << choice;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(list_devices().front().name), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find(choice), std::string::npos) << error.what();
    }
  }
}

TEST(Device, IsOpenedOnceForAll) { EXPECT_EQ(Device::open(), Device::open()); }

TEST(Device, ServesSeveralThreads) {
  const auto device = Device::open();
  const ComputePipeline pipeline(*device, times_factor(), kInputs);
  std::vector<std::thread> threads;
  std::vector<int> wrong(4);
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&, t] {
      for (int repeat = 0; repeat < 20; ++repeat) {
        const float factor = static_cast<float>(t + 1);
        const std::vector<float> values = run(*device, pipeline, factor, 256);
        for (std::size_t i = 0; i < values.size(); ++i) wrong[t] += values[i] != factor * static_cast<float>(i);
      }
    });
  for (std::thread& thread : threads) thread.join();
  for (int t = 0; t < 4; ++t) EXPECT_EQ(wrong[t], 0);
}

// An index out of bounds is the first or the last one.
TEST(Device, ReadsAndWritesOutOfBounds_StayInBounds) {
  const auto device = Device::open();
  const ComputePipeline pipeline(*device, compile(R"(void main() {
    uint i = gl_GlobalInvocationID.x;
    float local[4] = float[](1.0, 2.0, 3.0, 4.0);
    uint far = i * 123456789u + count * 1000u;
    local[far] = 7.0;
    b[far] = a[far * 3u] + local[far * 5u];
    b[i] = factor;
  })"),
                                 kInputs);
  const std::vector<float> values = run(*device, pipeline, 3, 1024);
  for (std::size_t i = 1; i + 1 < values.size(); ++i) ASSERT_EQ(values[i], 3) << i;
}

// The device goes on working on what took too long, so it must not be used again, and nothing of it be freed.
/// While it lives, what is allocated may stay. A device that was given up is kept on purpose, since it may still write;
/// the validation layer forgets at exit where its parts are, and whether the leak checker still sees them is chance.
struct MayStay {
#ifdef __SANITIZE_ADDRESS__
  MayStay() { __lsan_disable(); }
  ~MayStay() { __lsan_enable(); }
#endif
};

TEST(Device, WorkThatDoesNotEndInTime_IsGivenUp_AndAnotherDeviceCanBeOpened) {
  const std::string slow = R"(void main() {
    uint i = gl_GlobalInvocationID.x;
    float x = a[i];
    for (uint k = 0u; k < 40000000u; k++) x = fract(x * 1.37 + factor);
    b[i] = x;
  })";
  {
    [[maybe_unused]] const MayStay given_up;
    const auto device = Device::open();
    const ComputePipeline pipeline(*device, compile(slow), kInputs);
    // llvmpipe leaves a loop after 65535 rounds: many groups take their time all the same.
    EXPECT_THROW(run(*device, pipeline, 1, 4096 * kGroup, milliseconds(1)), DeviceTimeout);
    EXPECT_THROW(run(*device, pipeline, 1, kGroup, milliseconds(1)), Error);
  }
  const auto device = Device::open();
  EXPECT_EQ(run(*device, ComputePipeline(*device, times_factor(), kInputs), 1, kGroup)[3], 3);
}

TEST(Device, SamplesAPictureBilinearlyFromItsLowerLeftCornerAndRepeatsIt) {
  Image image(2, 2, 3);
  image.set_rgb(0, 0, {1, 0, 0}), image.set_rgb(1, 0, {0, 1, 0});  // top row
  image.set_rgb(0, 1, {0, 0, 1}), image.set_rgb(1, 1, {1, 1, 1});
  const auto device = Device::open();
  const ComputePipeline pipeline(*device, compile(R"(
    layout(binding = 2) uniform sampler2D image;
    void main() {
      vec4 corner = texture(image, vec2(0.25, 0.75)), same = texture(image, vec2(1.25, -0.25));
      vec4 middle = texture(image, vec2(0.5, 0.5));
      b[0] = corner.r, b[1] = corner.g, b[2] = corner.a, b[3] = distance(corner, same), b[4] = middle.r, b[5] = middle.g;
    })"),
                                 {2, 1, sizeof(Push)});
  const DeviceImage on_device(*device, image);
  DeviceBuffer in(*device, 64), out(*device, 64);
  ComputeTask task(pipeline);
  task.bind(0, in), task.bind(1, out), task.bind(2, on_device);
  const Push push{};
  task.run(std::as_bytes(std::span(&push, 1)), {}, kSoon);
  float found[6];
  std::memcpy(found, out.data(), sizeof found);
  const float expected[6] = {1, 0, 1, 0, 0.5f, 0.5f};
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(found[i], expected[i], 1e-3f) << i;
}

TEST(Device, BufferLargerThanItsLimit_IsRefused) {
  const auto device = Device::open();
  EXPECT_THROW(DeviceBuffer(*device, device->largest_buffer() + 1), Error);
}

// Also a test of the tests: all run with the validation layer, and what it says is thrown.
TEST(Device, WhatTheValidationLayerFindsWrong_IsThrown) {
  const auto device = Device::open();
  std::vector<std::uint32_t> broken = times_factor();
  broken[1] = 0x00010600;  // SPIR-V 1.6, which Vulkan 1.1 does not know
  EXPECT_THROW(ComputePipeline(*device, broken, kInputs), Error);
}

}  // namespace
}  // namespace redmap
