// Reading declarations by tokens: no compiler, no grammar, one line number for every complaint.
#include "shader/shader_text.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "base/error.h"

namespace redmap {
namespace {

struct Line {
  std::string code, comment;
};

/// Splits every line into code and `//` comment; block comments vanish.
std::vector<Line> read_lines(std::string_view text) {
  std::vector<Line> lines;
  std::istringstream stream{std::string(text)};
  bool in_block = false;
  for (std::string raw; std::getline(stream, raw);) {
    if (raw.ends_with('\r')) raw.pop_back();
    Line line;
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

std::string trimmed(std::string_view s) {
  const auto first = s.find_first_not_of(" \t"), last = s.find_last_not_of(" \t");
  return std::string(first == std::string_view::npos ? "" : s.substr(first, last - first + 1));
}

/// A word (name or number) or a single other character.
struct Token {
  std::string text;
  std::size_t line;  ///< counted from 0
};

std::vector<Token> read_tokens(const std::vector<Line>& lines) {
  const auto in_word = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; };
  std::vector<Token> tokens;
  for (std::size_t l = 0; l < lines.size(); ++l) {
    const std::string& code = lines[l].code;
    for (std::size_t i = 0; i < code.size();) {
      std::size_t end = i + 1;
      while (in_word(code[i]) && end < code.size() && in_word(code[end])) ++end;
      if (!std::isspace(static_cast<unsigned char>(code[i]))) tokens.push_back({code.substr(i, end - i), l});
      i = end;
    }
  }
  return tokens;
}

/// Where `words` stand one after the other for the first time; tokens.size() if nowhere.
std::size_t find(const std::vector<Token>& tokens, std::initializer_list<std::string_view> words) {
  const auto same = [](const Token& token, std::string_view word) { return token.text == word; };
  const auto found = std::search(tokens.begin(), tokens.end(), words.begin(), words.end(), same);
  return static_cast<std::size_t>(found - tokens.begin());
}

/// Whether there is a function `TYPE NAME(FIRST ...`.
bool defines(const std::vector<Token>& tokens, std::string_view type, std::string_view name, std::string_view first) {
  return find(tokens, {type, name, "(", first}) < tokens.size() ||
         find(tokens, {type, name, "(", "in", first}) < tokens.size();
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
ParameterInfo read_parameter(const std::vector<Line>& lines, const std::vector<Token>& tokens, std::size_t at,
                             std::string_view file_name) {
  const std::size_t line = tokens[at].line;
  const std::string where = fmt::format("{}:{}", file_name, line + 1);
  const auto on_line = std::ranges::count(tokens, line, &Token::line);
  if (on_line != 3 || tokens[at + 2].text != ";")
    throw Error("{}: expected one parameter 'TYPE NAME;' on a line, found '{}'", where, trimmed(lines[line].code));
  ParameterInfo parameter{tokens[at + 1].text, tokens[at].text, {}, 0, 0, "", ""};
  if (components_of(parameter.type) == 0)
    throw Error("{}: parameter '{}' has type '{}', expected float, int, vec2 or vec3", where, parameter.name,
                parameter.type);
  read_comment(lines[line].comment, where, parameter);
  return parameter;
}

std::vector<ParameterInfo> read_parameters(const std::vector<Line>& lines, const std::vector<Token>& tokens,
                                           std::string_view file_name) {
  const std::size_t start = find(tokens, {"struct", "Parameters", "{"});
  if (start == tokens.size()) throw Error("{}:1: expected 'struct Parameters {{', found none", file_name);
  std::vector<ParameterInfo> parameters;
  for (std::size_t at = start + 3; at < tokens.size(); at += 3) {
    if (tokens[at].text == "}") return parameters;
    const ParameterInfo parameter = read_parameter(lines, tokens, at, file_name);
    if (std::ranges::find(parameters, parameter.name, &ParameterInfo::name) != parameters.end())
      throw Error("{}:{}: parameter '{}' is declared twice", file_name, tokens[at].line + 1, parameter.name);
    parameters.push_back(parameter);
  }
  throw Error("{}:{}: 'struct Parameters' is not closed by '}}'", file_name, tokens[start].line + 1);
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

}  // namespace

ShaderInfo parse_shader_text(std::string_view text, std::string_view file_name) {
  const std::vector<Line> lines = read_lines(text);
  const std::vector<Token> tokens = read_tokens(lines);

  ShaderInfo info;
  info.name = std::filesystem::path(file_name).stem().string();
  const auto summary = std::ranges::find_if(lines, [](const Line& l) { return !trimmed(l.comment).empty(); });
  if (summary != lines.end()) info.summary = trimmed(summary->comment);
  info.parameters = read_parameters(lines, tokens, file_name);

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
  info.varies_in_time = find(tokens, {".", "time"}) < tokens.size();
  return info;
}

std::string resolve_includes(std::string_view text, const ReadInclude& read) {
  std::vector<std::string> open;
  return resolve_includes(text, read, open);
}

}  // namespace redmap
