// Reading declarations by tokens: no compiler, no grammar, one line number for every complaint.
#include "shader/shader_text.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "base/error.h"
#include "shader/shader_tokens.h"

namespace redmap {
namespace {

using Lines = std::vector<ShaderLine>;

/// Whether there is a function `TYPE NAME(FIRST ...`.
bool defines(const ShaderTokens& tokens, std::string_view type, std::string_view name, std::string_view first) {
  return find_tokens(tokens, {type, name, "(", first}) < tokens.size() ||
         find_tokens(tokens, {type, name, "(", "in", first}) < tokens.size();
}

/// Whether `.time` is read of anything declared as a Surface, of what a function returns, or of an element of an array.
bool reads_time(const ShaderTokens& tokens) {
  for (const char* end : {")", "]"})
    if (find_tokens(tokens, {end, ".", "time"}) < tokens.size()) return true;
  for (std::size_t i = 0; i + 1 < tokens.size(); ++i)
    if (tokens[i].text == "Surface" && find_tokens(tokens, {tokens[i + 1].text, ".", "time"}) < tokens.size())
      return true;
  return false;
}

std::size_t components_of(const std::string& type) {
  return type == "float" || type == "int" ? 1 : type == "vec2" ? 2 : type == "vec3" ? 3 : 0;
}

/// All numbers in `text`; throws where something else stands between them.
std::vector<float> read_numbers(std::string_view text, const std::string& where) {
  std::vector<float> numbers;
  std::istringstream words{std::string(text)};
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

/// Reads `14 [0.1, 1000] 1/unit: cells per object unit` into `parameter`, which has a name and a type.
void read_comment(std::string_view comment, const std::string& where, ParameterInfo& parameter) {
  const auto open = comment.find('['), comma = comment.find(',', open), close = comment.find(']', comma);
  const auto colon = comment.find(':', close);
  if (open == std::string_view::npos || comma == open || close == comma || colon == std::string_view::npos)
    throw Error("{}: parameter '{}' needs a comment '// DEFAULT [MINIMUM, MAXIMUM] UNIT: MEANING', found '{}'", where,
                parameter.name, trimmed(comment));
  parameter.default_value = read_numbers(comment.substr(0, open), where);
  const auto minimum = read_numbers(comment.substr(open + 1, comma - open - 1), where);
  const auto maximum = read_numbers(comment.substr(comma + 1, close - comma - 1), where);
  if (minimum.size() != 1 || maximum.size() != 1)
    throw Error("{}: parameter '{}' needs a range [MINIMUM, MAXIMUM]", where, parameter.name);
  parameter.minimum = minimum[0], parameter.maximum = maximum[0];
  parameter.unit = trimmed(comment.substr(close + 1, colon - close - 1));
  parameter.meaning = trimmed(comment.substr(colon + 1));
  check_default(parameter, where);
}

/// The member that starts at token `at`: `TYPE NAME;`, alone on its line, with its comment.
ParameterInfo read_parameter(const Lines& lines, const ShaderTokens& tokens, std::size_t at) {
  const std::size_t line = tokens[at].line;
  const std::string& where = lines[line].where;
  const auto on_line = std::ranges::count(tokens, line, &ShaderToken::line);
  if (on_line != 3 || tokens[at + 2].text != ";")
    throw Error("{}: expected one parameter 'TYPE NAME;' on a line, found '{}'", where, trimmed(lines[line].code));
  ParameterInfo parameter{tokens[at + 1].text, tokens[at].text, {}, 0, 0, "", ""};
  if (components_of(parameter.type) == 0)
    throw Error("{}: parameter '{}' has type '{}', expected float, int, vec2 or vec3", where, parameter.name,
                parameter.type);
  read_comment(lines[line].comment, where, parameter);
  return parameter;
}

std::vector<ParameterInfo> read_parameters(const Lines& lines, const ShaderTokens& tokens,
                                           const std::string& file_name) {
  const std::size_t start = find_tokens(tokens, {"struct", "Parameters", "{"});
  if (start == tokens.size()) throw Error("{}:1: expected 'struct Parameters {{', found none", file_name);
  std::vector<ParameterInfo> parameters;
  for (std::size_t at = start + 3; at < tokens.size(); at += 3) {
    if (tokens[at].text == "}") return parameters;
    const ParameterInfo parameter = read_parameter(lines, tokens, at);
    if (std::ranges::find(parameters, parameter.name, &ParameterInfo::name) != parameters.end())
      throw Error("{}: parameter '{}' is declared twice", lines[tokens[at].line].where, parameter.name);
    parameters.push_back(parameter);
  }
  throw Error("{}: 'struct Parameters' is not closed by '}}'", lines[tokens[start].line].where);
}

/// `uniform sampler2D NAME;  // MEANING`, each alone on its line.
std::vector<ShaderImageInfo> read_images(const Lines& lines, const ShaderTokens& tokens) {
  std::vector<ShaderImageInfo> images;
  for (std::size_t at = 0; at + 3 < tokens.size(); ++at) {
    if (tokens[at].text != "uniform" || tokens[at + 1].text != "sampler2D") continue;
    const ShaderLine& line = lines[tokens[at].line];
    if (tokens[at + 3].text != ";")
      throw Error("{}: expected one image 'uniform sampler2D NAME;' on a line, found '{}'", line.where,
                  trimmed(line.code));
    images.push_back({tokens[at + 2].text, trimmed(line.comment), {}, false});
  }
  return images;
}

/// The name in a line `#include "NAME"`, else empty.
std::string included_name(std::string_view line) {
  std::string rest = trimmed(line.substr(0, line.find('\r')));
  for (const std::string_view word : {"#", "include"}) {
    if (!rest.starts_with(word)) return "";
    rest = trimmed(std::string_view(rest).substr(word.size()));
  }
  return rest.size() > 2 && rest.front() == '"' && rest.back() == '"' ? rest.substr(1, rest.size() - 2) : "";
}

using ReadInclude = std::function<std::string(std::string_view)>;

/// Whether `line` is the directive `#version`.
bool is_version(std::string_view line) {
  const std::string rest = trimmed(line);
  return rest.starts_with("#") && trimmed(std::string_view(rest).substr(1)).starts_with("version");
}

/// Puts a text together from its files.
class SourceReader {
 public:
  explicit SourceReader(const ReadSource& read) : read_(read) {}
  ShaderSources take() { return std::move(sources_); }

  void add(const ShaderSource& source) {
    const std::size_t index = sources_.names.size();
    sources_.names.push_back(source.name);
    open_.push_back(source.name);
    sources_.text += fmt::format("#line 1 {}\n", index);
    std::istringstream stream(source.text);
    std::size_t number = 1;
    for (std::string line; std::getline(stream, line); ++number) {
      const std::string included = included_name(line);
      if (included.empty()) {
        sources_.text += (is_version(line) ? "" : line) + "\n";
        continue;
      }
      const std::string where = fmt::format("{}:{}", source.name, number);
      const ShaderSource next = read_(included, source.name, where);
      if (std::ranges::count(open_, next.name) > 0)
        throw Error("{}: include \"{}\" leads back to itself", where, included);
      add(next);
      sources_.text += fmt::format("#line {} {}\n", number + 1, index);
    }
    open_.pop_back();
  }

 private:
  const ReadSource& read_;
  ShaderSources sources_;
  std::vector<std::string> open_;  ///< the includes that lead here
};

/// `open` are the includes that lead here.
std::string resolve_includes(std::string_view text, const ReadInclude& read, std::vector<std::string>& open) {
  std::string resolved;
  std::istringstream stream{std::string(text)};
  for (std::string line; std::getline(stream, line);) {
    const std::string name = included_name(line);
    if (name.empty()) {
      resolved += line + "\n";
      continue;
    }
    if (std::ranges::count(open, name) > 0) throw Error("shader include '{}' leads back to itself", name);
    open.push_back(name);
    resolved += resolve_includes(read(name), read, open);
    open.pop_back();
  }
  return resolved;
}

ShaderInfo read_declaration(const Lines& lines, const ShaderTokens& tokens, const std::string& file_name) {
  ShaderInfo info;
  info.name = std::filesystem::path(file_name).stem().string();
  const auto summary = std::ranges::find_if(lines, [](const ShaderLine& l) { return !trimmed(l.comment).empty(); });
  if (summary != lines.end()) info.summary = trimmed(summary->comment);
  info.parameters = read_parameters(lines, tokens, file_name);
  return info;
}

}  // namespace

ShaderInfo parse_declaration(std::string_view text, const std::string& source_name) {
  const std::string names[] = {source_name};
  const Lines lines = read_shader_lines(text, names);
  return read_declaration(lines, read_shader_tokens(lines), source_name);
}

ShaderInfo parse_shader_text(std::string_view text, std::string_view file_name) {
  const std::string names[] = {std::string(file_name)};
  return parse_shader_text(text, names);
}

ShaderInfo parse_shader_text(std::string_view text, std::span<const std::string> source_names) {
  const std::string& file_name = source_names.front();
  const Lines lines = read_shader_lines(text, source_names);
  const ShaderTokens tokens = read_shader_tokens(lines);

  ShaderInfo info = read_declaration(lines, tokens, file_name);
  info.images = read_images(lines, tokens);
  const bool split = defines(tokens, "Pattern", "pattern", "Surface");
  info.black_box = defines(tokens, "vec3", "radiance", "Surface");
  if (split == info.black_box)
    throw Error("{}:1: expected 'Pattern pattern(Surface, Parameters)' or 'vec3 radiance(Surface, ...)', found {}",
                file_name, split ? "both" : "neither");
  if (split && !defines(tokens, "vec3", "radiance", "Pattern"))
    throw Error("{}:1: expected 'vec3 radiance(Pattern, vec3, vec3)' beside pattern(), found none", file_name);
  info.transmits = defines(tokens, "vec3", "transmittance", "Pattern");
  info.emits = defines(tokens, "vec3", "emission", "Pattern");
  info.has_material = defines(tokens, "Material", "material", "Pattern");
  info.perturbs_normals = defines(tokens, "vec3", "shading_normal", "Surface");
  info.turns_tangents = defines(tokens, "vec3", "shading_tangent", "Surface");
  info.varies_in_time = reads_time(tokens);
  return info;
}

ShaderSources resolve_sources(const ShaderSource& main, const ReadSource& read) {
  SourceReader reader(read);
  reader.add(main);
  return reader.take();
}

void require_own_world(std::string_view text, std::span<const std::string> source_names) {
  const Lines lines = read_shader_lines(text, source_names);
  const ShaderTokens tokens = read_shader_tokens(lines);
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    const std::string& word = tokens[i].text;
    const bool is_image = word == "uniform" && i + 1 < tokens.size() && tokens[i + 1].text == "sampler2D";
    const bool is_foreign =
        word == "buffer" || word == "shared" || word == "uniform" || word == "barrier" || word.starts_with("gl_");
    const bool is_derivative = word.starts_with("dFdx") || word.starts_with("dFdy") || word.starts_with("fwidth");
    if (is_derivative && find_tokens(tokens, {"define", word}) == tokens.size())
      throw Error(
          "{}:{}: '{}': there is no screen to take derivatives on: leave antialiasing out, redmap filters what "
          "the shader is at each place",
          lines[tokens[i].line].where, tokens[i].column + 1, word);
    if (is_foreign && !is_image)
      throw Error("{}:{}: '{}': a shader knows its Surface, its Parameters and images (uniform sampler2D NAME;) only",
                  lines[tokens[i].line].where, tokens[i].column + 1, word);
  }
}

std::string resolve_includes(std::string_view text, const ReadInclude& read) {
  std::vector<std::string> open;
  return resolve_includes(text, read, open);
}

}  // namespace redmap
