#include "device/glsl_compiler.h"

#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <glslang/SPIRV/GlslangToSpv.h>

#include <cctype>
#include <cstdio>
#include <map>
#include <spirv-tools/libspirv.hpp>
#include <spirv-tools/optimizer.hpp>
#include <sstream>

#include "base/error.h"
#include "device/loop_guard.h"
#include "device/spirv_checks.h"
#include "device/spirv_words.h"

namespace redmap {
namespace {

constexpr auto kMessages = static_cast<EShMessages>(EShMsgSpvRules | EShMsgVulkanRules);
constexpr spv_target_env kEnvironment = SPV_ENV_VULKAN_1_1;

/// The text of line `line` of source `source`; empty if there is none.
std::string find_line(const std::string& text, int source, int line) {
  int current_source = 0, current_line = 1;
  std::istringstream stream(text);
  for (std::string raw; std::getline(stream, raw); ++current_line) {
    int next_line = 0, next_source = 0;
    if (std::sscanf(raw.c_str(), " # line %d %d", &next_line, &next_source) == 2)
      current_line = next_line - 1, current_source = next_source;
    else if (current_source == source && current_line == line)
      return raw;
  }
  return {};
}

bool in_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

/// Where `token` stands in `line` as a word of its own, counted from 1; where it does not, the first column with text.
/// glslang tells lines only.
std::size_t column_of(const std::string& line, const std::string& token) {
  for (std::size_t at = line.find(token); !token.empty() && at != std::string::npos; at = line.find(token, at + 1)) {
    const std::size_t end = at + token.size();
    const bool starts_inside = at > 0 && in_word(line[at - 1]) && in_word(token.front());
    const bool ends_inside = end < line.size() && in_word(line[end]) && in_word(token.back());
    if (!starts_inside && !ends_inside) return at + 1;
  }
  const std::size_t first = line.find_first_not_of(" \t");
  return first == std::string::npos ? 1 : first + 1;
}

/// The first error of glslang's log, "ERROR: SOURCE:LINE: 'TOKEN' : MESSAGE", in our words.
std::string first_error(const std::string& log, const std::string& text, std::span<const std::string> source_names) {
  const std::string first = log.substr(0, log.find('\n'));
  int source = 0, line = 0, after = 0;
  const bool has_place = std::sscanf(first.c_str(), "ERROR: %d:%d: '%n", &source, &line, &after) == 2 && after > 0;
  const std::size_t end = has_place ? first.find("' : ", after) : std::string::npos;
  if (end == std::string::npos) return first;
  const std::string token = first.substr(after, end - after);
  std::string message = first.substr(first.find_first_not_of(' ', end + 4));
  message.erase(message.find_last_not_of(" \t\r") + 1);
  const std::string name =
      source < static_cast<int>(source_names.size()) ? source_names[source] : fmt::format("source {}", source);
  return fmt::format("{}:{}:{}: {}{}", name, line, column_of(find_line(text, source, line), token),
                     token.empty() ? "" : fmt::format("'{}': ", token), message);
}

/// Keeps glslang's tables for the whole process: making them takes 70 ms.
void initialise_glslang() { [[maybe_unused]] static const bool done = glslang::InitializeProcess(); }

/// Clamps every index, also those into private arrays, which no device checks, and validates the whole.
std::vector<std::uint32_t> finished(const std::vector<std::uint32_t>& spirv) {
  std::string problem;
  const auto hear = [&](spv_message_level_t, const char*, const spv_position_t&, const char* message) {
    if (problem.empty()) problem = message;
  };
  spvtools::Optimizer optimizer(kEnvironment);
  optimizer.SetMessageConsumer(hear);
  optimizer.RegisterPass(spvtools::CreateGraphicsRobustAccessPass());
  spvtools::SpirvTools tools(kEnvironment);
  tools.SetMessageConsumer(hear);
  std::vector<std::uint32_t> result;
  // Making readable names takes longer than all else.
  spvtools::ValidatorOptions validation;
  validation.SetFriendlyNames(false);
  spvtools::OptimizerOptions optimization;
  optimization.set_run_validator(false);
  if (!optimizer.Run(spirv.data(), spirv.size(), &result, optimization) ||
      !tools.Validate(result.data(), result.size(), validation))
    throw Error("expected a shader that Vulkan takes, found: {}", problem);
  return result;
}

/// As glslang translates it.
std::vector<std::uint32_t> translated(const std::string& text, std::span<const std::string> source_names,
                                      EShLanguage stage) {
  initialise_glslang();
  glslang::TShader shader(stage);
  const char* strings = text.c_str();
  shader.setStrings(&strings, 1);
  shader.setEnvInput(glslang::EShSourceGlsl, stage, glslang::EShClientVulkan, 100);
  shader.setEnvClient(glslang::EShClientVulkan, glslang::EShTargetVulkan_1_1);
  shader.setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_3);
  if (!shader.parse(GetDefaultResources(), 450, false, kMessages))
    throw Error("{}", first_error(shader.getInfoLog(), text, source_names));
  glslang::TProgram program;
  program.addShader(&shader);
  if (!program.link(kMessages)) throw Error("{}", first_error(program.getInfoLog(), text, source_names));
  std::vector<std::uint32_t> spirv;
  glslang::SpvOptions options;
  options.disableOptimizer = true;  // drivers optimise
  glslang::GlslangToSpv(*program.getIntermediate(stage), spirv, &options);
  return spirv;
}

}  // namespace

std::vector<std::uint32_t> compile_glsl(const std::string& text, std::span<const std::string> source_names,
                                        const std::string& loop_guard) {
  const std::vector<std::uint32_t> spirv = translated(text, source_names, EShLangCompute);
  try {
    check_spirv(spirv);
    return finished(loop_guard.empty() ? spirv : guard_loops(spirv, loop_guard));
  } catch (const Error& error) {
    throw Error("{}: {}", source_names.front(), error.what());
  }
}

std::vector<std::uint32_t> compile_own_glsl(const std::string& text, const std::string& name, GlslStage stage) {
  const EShLanguage language = stage == GlslStage::kCompute  ? EShLangCompute
                               : stage == GlslStage::kVertex ? EShLangVertex
                                                             : EShLangFragment;
  return translated(text, {&name, 1}, language);
}

std::size_t array_stride(std::span<const std::uint32_t> spirv, const std::string& name) {
  // Names and decorations come before the types that they belong to.
  std::uint32_t block = 0;
  std::map<std::uint32_t, std::size_t> strides;
  std::size_t stride = 0;
  for_each_instruction(spirv, [&](std::span<const std::uint32_t> i) {
    const spv::Op op = operation(i);
    if (op == spv::OpName && reinterpret_cast<const char*>(&i[2]) == name) block = i[1];
    if (op == spv::OpDecorate && i[2] == spv::DecorationArrayStride) strides[i[1]] = i[3];
    if (op == spv::OpTypeStruct && i[1] == block && i.size() == 3) stride = strides[i[2]];
  });
  if (stride == 0) throw Error("expected a buffer block {} of one array, found none", name);
  return stride;
}

}  // namespace redmap
