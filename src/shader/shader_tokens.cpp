#include "shader/shader_tokens.h"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <sstream>

#include "base/error.h"

namespace redmap {
namespace {

/// Takes `raw` apart. `in_block`: whether a block comment is open, before and after.
ShaderLine split_comment(std::string_view raw, bool& in_block) {
  ShaderLine line;
  for (std::size_t i = 0; i < raw.size(); ++i) {
    const std::string_view rest = raw.substr(i);
    if (in_block || rest.starts_with("/*")) {
      const bool is_mark = rest.starts_with(in_block ? "*/" : "/*");
      line.code += is_mark ? "  " : " ";
      if (is_mark) in_block = !in_block, ++i;
    } else if (rest.starts_with("//")) {
      line.comment = rest.substr(2);
      break;
    } else {
      line.code += raw[i];
    }
  }
  return line;
}

}  // namespace

std::vector<ShaderLine> read_shader_lines(std::string_view text, std::span<const std::string> source_names) {
  std::vector<ShaderLine> lines;
  std::istringstream stream{std::string(text)};
  bool in_block = false;
  std::size_t number = 1, source = 0;
  for (std::string raw; std::getline(stream, raw); ++number) {
    if (raw.ends_with('\r')) raw.pop_back();
    std::size_t next_number = 0, next_source = 0;
    const bool is_directive = std::sscanf(raw.c_str(), " # line %zu %zu", &next_number, &next_source) == 2;
    if (is_directive && next_source < source_names.size()) {
      number = next_number - 1, source = next_source;
      continue;
    }
    lines.push_back(split_comment(raw, in_block));
    lines.back().where = fmt::format("{}:{}", source_names[source], number);
  }
  return lines;
}

ShaderTokens read_shader_tokens(const std::vector<ShaderLine>& lines) {
  const auto in_word = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; };
  ShaderTokens tokens;
  for (std::size_t l = 0; l < lines.size(); ++l) {
    const std::string& code = lines[l].code;
    for (std::size_t i = 0; i < code.size();) {
      std::size_t end = i + 1;
      while (in_word(code[i]) && end < code.size() && in_word(code[end])) ++end;
      if (!std::isspace(static_cast<unsigned char>(code[i]))) tokens.push_back({code.substr(i, end - i), l, i});
      i = end;
    }
  }
  return tokens;
}

std::size_t find_tokens(const ShaderTokens& tokens, std::initializer_list<std::string_view> words) {
  const auto same = [](const ShaderToken& token, std::string_view word) { return token.text == word; };
  const auto found = std::search(tokens.begin(), tokens.end(), words.begin(), words.end(), same);
  return static_cast<std::size_t>(found - tokens.begin());
}

std::string trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t"), last = text.find_last_not_of(" \t");
  return std::string(first == std::string_view::npos ? "" : text.substr(first, last - first + 1));
}

}  // namespace redmap
