#include "shader/shader_text.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <regex>
#include <sstream>

#include "base/error.h"

namespace redmap {
namespace {

struct Line {
  int number;
  std::string code, comment;
};

/// Splits every line into code and `//` comment; block comments become spaces.
std::vector<Line> read_lines(std::string_view text) {
  std::vector<Line> lines;
  std::istringstream stream{std::string(text)};
  bool in_block = false;
  for (std::string raw; std::getline(stream, raw);) {
    if (raw.ends_with('\r')) raw.pop_back();
    Line line{static_cast<int>(lines.size()) + 1, "", ""};
    for (std::size_t i = 0; i < raw.size(); ++i) {
      const std::string_view rest = std::string_view(raw).substr(i);
      if (in_block) {
        if (rest.starts_with("*/")) in_block = false, ++i;
      } else if (rest.starts_with("/*")) {
        in_block = true, ++i;
      } else if (rest.starts_with("//")) {
        line.comment = rest.substr(2);
        break;
      } else {
        line.code += raw[i];
      }
    }
    lines.push_back(std::move(line));
  }
  return lines;
}

std::string trimmed(const std::string& s) {
  const auto first = s.find_first_not_of(" \t"), last = s.find_last_not_of(" \t");
  return first == std::string::npos ? "" : s.substr(first, last - first + 1);
}

std::size_t components_of(const std::string& type) {
  return type == "float" || type == "int" ? 1 : type == "vec2" ? 2 : type == "vec3" ? 3 : 0;
}

/// All numbers in `text`; throws where something else stands between them.
std::vector<float> read_numbers(const std::string& text, const std::string& where) {
  std::vector<float> numbers;
  std::istringstream words{text};
  for (std::string word; words >> word;) {
    char* end = nullptr;
    const float value = std::strtof(word.c_str(), &end);
    if (*end != '\0' || !std::isfinite(value)) throw Error("{}: expected a number, found '{}'", where, word);
    numbers.push_back(value);
  }
  return numbers;
}

void check_default(const ParameterInfo& parameter, const std::string& where) {
  if (!(parameter.minimum <= parameter.maximum))
    throw Error("{}: parameter '{}' has the empty range [{}, {}]", where, parameter.name, parameter.minimum,
                parameter.maximum);
  if (parameter.default_value.size() != components_of(parameter.type))
    throw Error("{}: parameter '{}' is a {} and needs a default of {} number(s), found {}", where, parameter.name,
                parameter.type, components_of(parameter.type), parameter.default_value.size());
  for (const float value : parameter.default_value)
    if (value < parameter.minimum || value > parameter.maximum)
      throw Error("{}: parameter '{}' has the default {} outside its range [{}, {}]", where, parameter.name, value,
                  parameter.minimum, parameter.maximum);
}

/// One member: `float scale;  // 14 [0.1, 1000] 1/unit: cells per object unit`.
ParameterInfo read_parameter(const Line& line, const std::string& where) {
  static const std::regex member(R"(\s*(\w+)\s+([A-Za-z_]\w*)\s*;\s*)");
  static const std::regex comment(R"(\s*([^\[\]]*)\[([^,\]]*),([^,\]]*)\]\s*([^:]*):\s*(.*))");
  std::smatch declared, described;
  if (!std::regex_match(line.code, declared, member))
    throw Error("{}: expected one parameter 'TYPE NAME;' on a line, found '{}'", where, trimmed(line.code));
  ParameterInfo parameter;
  parameter.type = declared[1], parameter.name = declared[2];
  if (components_of(parameter.type) == 0)
    throw Error("{}: parameter '{}' has type '{}', expected float, int, vec2 or vec3", where, parameter.name,
                parameter.type);
  if (!std::regex_match(line.comment, described, comment))
    throw Error("{}: parameter '{}' needs a comment '// DEFAULT [MINIMUM, MAXIMUM] UNIT: MEANING', found '{}'", where,
                parameter.name, trimmed(line.comment));
  parameter.default_value = read_numbers(described[1], where);
  const auto range = read_numbers(described[2].str() + " " + described[3].str(), where);
  if (range.size() != 2) throw Error("{}: parameter '{}' needs a range of two numbers", where, parameter.name);
  parameter.minimum = range[0], parameter.maximum = range[1];
  parameter.unit = trimmed(described[4]), parameter.meaning = trimmed(described[5]);
  check_default(parameter, where);
  return parameter;
}

std::vector<ParameterInfo> read_parameters(const std::vector<Line>& lines, std::string_view file_name) {
  static const std::regex opening(R"(\s*struct\s+Parameters\s*\{\s*)"), closing(R"(\s*\}\s*;\s*)");
  auto line = std::ranges::find_if(lines, [&](const Line& l) { return std::regex_match(l.code, opening); });
  if (line == lines.end()) throw Error("{}:1: expected a line 'struct Parameters {{', found none", file_name);
  const int opened_at = line->number;
  std::vector<ParameterInfo> parameters;
  for (++line; line != lines.end(); ++line) {
    if (std::regex_match(line->code, closing)) return parameters;
    if (trimmed(line->code).empty()) continue;
    const std::string where = fmt::format("{}:{}", file_name, line->number);
    parameters.push_back(read_parameter(*line, where));
    const auto same_name = [&](const ParameterInfo& other) { return other.name == parameters.back().name; };
    if (std::ranges::count_if(parameters, same_name) > 1)
      throw Error("{}: parameter '{}' is declared twice", where, parameters.back().name);
  }
  throw Error("{}:{}: 'struct Parameters' is not closed by a line '}};'", file_name, opened_at);
}

/// Whether the code defines `TYPE NAME(FIRST_PARAMETER_TYPE ...`.
bool defines(const std::string& code, const std::string& type, const std::string& name, const std::string& first) {
  return std::regex_search(code, std::regex("\\b" + type + "\\s+" + name + "\\s*\\(\\s*(in\\s+)?" + first + "\\b"));
}

}  // namespace

ShaderInfo parse_shader_text(std::string_view text, std::string_view file_name) {
  const std::vector<Line> lines = read_lines(text);
  std::string code;
  for (const Line& line : lines) code += line.code + "\n";

  ShaderInfo info;
  info.name = std::filesystem::path(file_name).stem().string();
  const auto summary = std::ranges::find_if(lines, [](const Line& l) { return !trimmed(l.comment).empty(); });
  if (summary != lines.end()) info.summary = trimmed(summary->comment);
  info.parameters = read_parameters(lines, file_name);

  const bool split = defines(code, "Pattern", "pattern", "Surface");
  info.black_box = defines(code, "vec3", "radiance", "Surface");
  if (split == info.black_box)
    throw Error(
        "{}:1: expected either 'Pattern pattern(Surface, Parameters)' or 'vec3 radiance(Surface, ...)', found {}",
        file_name, split ? "both" : "neither");
  if (split && !defines(code, "vec3", "radiance", "Pattern"))
    throw Error("{}:1: expected 'vec3 radiance(Pattern, vec3, vec3)' beside pattern(), found none", file_name);
  info.transmits = defines(code, "vec3", "transmittance", "Pattern");
  info.emits = defines(code, "vec3", "emission", "Pattern");
  info.has_material = defines(code, "Material", "material", "Pattern");
  info.varies_in_time = std::regex_search(code, std::regex(R"(\.\s*time\b)"));
  return info;
}

namespace {

std::string resolve_includes(std::string_view text, const std::function<std::string(std::string_view)>& read,
                             std::vector<std::string>& open) {
  static const std::regex include(R"(\s*#\s*include\s+"([^"]+)\"\s*)");
  std::string resolved;
  std::istringstream stream{std::string(text)};
  for (std::string line; std::getline(stream, line);) {
    std::smatch match;
    if (!std::regex_match(line, match, include)) {
      resolved += line + "\n";
      continue;
    }
    const std::string name = match[1];
    if (std::ranges::count(open, name) > 0) throw Error("shader include '{}' leads back to itself", name);
    open.push_back(name);
    resolved += resolve_includes(read(name), read, open);
    open.pop_back();
  }
  return resolved;
}

}  // namespace

std::string resolve_includes(std::string_view text, const std::function<std::string(std::string_view)>& read) {
  std::vector<std::string> open;
  return resolve_includes(text, read, open);
}

}  // namespace redmap
