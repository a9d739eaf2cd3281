// A shader's text cut into words, for reading its declarations without a compiler. Not part of the public interface.
#pragma once

#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace redmap {

/// A line of code, its `//` comment, and where it came from. Block comments are blanks, so that columns stay.
struct ShaderLine {
  std::string code, comment;
  std::string where;  ///< "mine.glsl:12"
};

/// Splits `text` into lines; `#line N I` says that line N of source_names[I] follows.
std::vector<ShaderLine> read_shader_lines(std::string_view text, std::span<const std::string> source_names);

/// A word (name or number) or a single other character.
struct ShaderToken {
  std::string text;
  std::size_t line, column;  ///< counted from 0
};
using ShaderTokens = std::vector<ShaderToken>;

ShaderTokens read_shader_tokens(const std::vector<ShaderLine>& lines);

/// Where `words` stand one after the other for the first time; tokens.size() if nowhere.
std::size_t find_tokens(const ShaderTokens& tokens, std::initializer_list<std::string_view> words);

/// Without blanks at its ends.
std::string trimmed(std::string_view text);

}  // namespace redmap
