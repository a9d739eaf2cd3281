// `redmap list`: the library's shaders, and what can be set on each, read from the shaders' own texts; and the devices
// that shaders of the user's own can run on.
#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "base/error.h"
#include "commands.h"
#include "common.h"
#include "device/device.h"
#include "shader/shader.h"
#include "user_shader/user_shader.h"

namespace redmap::cli {

namespace {

struct Options {
  std::string what = "shaders";  ///< "shaders", "parameters", "devices" or a shader's name
  std::string shader;
  CommonOptions common;
};

std::string numbers(const std::vector<float>& values) { return fmt::format("{}", fmt::join(values, " ")); }

nlohmann::json to_json(const ParameterInfo& parameter) {
  return {{"name", parameter.name},
          {"type", parameter.type},
          {"default", parameter.default_value},
          {"range", {parameter.minimum, parameter.maximum}},
          {"unit", parameter.unit},
          {"meaning", parameter.meaning}};
}

nlohmann::json to_json(const ShaderInfo& shader) {
  nlohmann::json parameters = nlohmann::json::array();
  for (const ParameterInfo& parameter : shader.parameters) parameters.push_back(to_json(parameter));
  return {{"name", shader.name},
          {"summary", shader.summary},
          {"black_box", shader.black_box},
          {"transmits", shader.transmits},
          {"emits", shader.emits},
          {"varies_in_time", shader.varies_in_time},
          {"perturbs_normals", shader.perturbs_normals},
          {"parameters", parameters}};
}

void list_shaders(const CommonOptions& common) {
  nlohmann::json shaders = nlohmann::json::array();
  for (const std::string& name : library_shader_names()) {
    const ShaderInfo& shader = library_shader_info(name);
    const std::size_t count = shader.parameters.size();
    fmt::print("{:18} {:2} {:10}  {}\n", name, count, count == 1 ? "parameter" : "parameters", shader.summary);
    shaders.push_back(to_json(shader));
  }
  write_json(common.json, {{"shaders", shaders}});
}

void list_parameters(const std::string& name, const CommonOptions& common) {
  const ShaderInfo shader = is_shader_file(name) ? user_shader_info(name, name) : library_shader_info(name);
  fmt::print("{}: {}\n", shader.name, shader.summary);
  for (const ParameterInfo& parameter : shader.parameters)
    fmt::print("  {:16} {:5} {:>14}  {:11} {:7} {}\n", parameter.name, parameter.type, numbers(parameter.default_value),
               fmt::format("[{}, {}]", parameter.minimum, parameter.maximum), parameter.unit, parameter.meaning);
  write_json(common.json, to_json(shader));
}

void list_all_devices(const CommonOptions& common) {
  nlohmann::json devices = nlohmann::json::array();
  for (const DeviceInfo& device : list_devices()) {
    fmt::print("{} {}: {}, {}, Vulkan {}\n", device.index, device.name, device.software ? "software" : "GPU",
               device.driver, device.vulkan_version);
    devices.push_back({{"index", device.index},
                       {"name", device.name},
                       {"driver", device.driver},
                       {"vulkan", device.vulkan_version},
                       {"software", device.software}});
  }
  if (devices.empty()) fmt::print("no device: no Vulkan driver is installed\n");
  write_json(common.json, {{"devices", devices}});
}

void list(const Options& options) {
  const bool asks_for_shaders = options.what == "shaders", asks_for_parameters = options.what == "parameters";
  if (asks_for_parameters && options.shader.empty())
    throw Error("list parameters: expected the name of a shader, found nothing (see redmap list shaders)");
  if (!asks_for_parameters && !options.shader.empty())
    throw Error("list {}: expected nothing after it, found \"{}\"", options.what, options.shader);
  if (asks_for_shaders) return list_shaders(options.common);
  if (options.what == "devices") return list_all_devices(options.common);
  list_parameters(asks_for_parameters ? options.shader : options.what, options.common);
}

}  // namespace

void add_list_command(CLI::App& app) {
  CLI::App* sub = app.add_subcommand("list", "Show the library's shaders, the parameters of one, or the devices");
  sub->footer(
      "Examples:\n"
      "  redmap list                   every shader, one line each\n"
      "  redmap list noise             its parameters: type, default, range, unit, meaning\n"
      "  redmap list parameters noise  the same\n"
      "  redmap list devices           what shaders of your own can run on");
  auto options = std::make_shared<Options>();
  sub->add_option("what", options->what,
                  "shaders (the default), parameters, devices, or the name of a shader or its file");
  sub->add_option("shader", options->shader, "after `parameters`: whose");
  add_common_options(*sub, options->common);
  sub->callback([options] { list(*options); });
}

}  // namespace redmap::cli
