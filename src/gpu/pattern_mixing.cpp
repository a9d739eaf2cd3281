#include "gpu/pattern_mixing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <optional>
#include <vector>

#include "shader/shader_tokens.h"

namespace redmap {
namespace {

/// Patterns with more members than this are not mixed: it would cost more than it saves.
constexpr std::size_t kMostMembers = 128;

bool is_float(const std::string& type) { return type == "float" || type.starts_with("vec") || type.starts_with("mat"); }
bool is_whole(const std::string& type) {
  return type == "int" || type == "uint" || type == "bool" || type.starts_with("ivec") || type.starts_with("uvec") ||
         type.starts_with("bvec");
}

/// The floats among the members of structs, by their paths (`coating.diffuse`, `layers[1].gloss`).
class MemberReader {
 public:
  explicit MemberReader(const ShaderSources& sources)
      : tokens_(read_shader_tokens(read_shader_lines(sources.text, sources.names))) {}

  /// False where a declaration is not understood.
  bool read(const std::string& name, const std::string& path) {
    std::optional<std::size_t> at = body_of(name);
    if (!at) return false;
    while (!is(*at, "}")) {
      const std::optional<std::size_t> end = read_members(*at, path);
      if (!end) return false;
      at = end;
    }
    return true;
  }
  const std::vector<std::string>& floats() const { return floats_; }

 private:
  bool is(std::size_t at, std::string_view text) const { return at < tokens_.size() && tokens_[at].text == text; }
  bool is_name(std::size_t at) const {
    if (at >= tokens_.size()) return false;
    const char c = tokens_[at].text.front();
    return std::isalpha(static_cast<unsigned char>(c)) || c == '_';
  }

  /// What follows the brace of the only declaration of a struct.
  std::optional<std::size_t> body_of(const std::string& name) const {
    std::optional<std::size_t> found;
    for (std::size_t i = 0; i + 2 < tokens_.size(); ++i) {
      if (!is(i, "struct") || !is(i + 1, name) || !is(i + 2, "{")) continue;
      if (found) return std::nullopt;
      found = i + 3;
    }
    return found;
  }

  /// `TYPE NAME, NAME[2];` from `at` on; where the next begins.
  std::optional<std::size_t> read_members(std::size_t at, const std::string& path) {
    if (!is_name(at)) return std::nullopt;
    const std::string type = tokens_[at].text;
    do {
      if (!is_name(++at)) return std::nullopt;
      const std::string member = path + tokens_[at++].text;
      std::size_t count = 0;
      if (is(at, "[")) {
        if (!is(at + 2, "]") || !read_count(tokens_[at + 1].text, count)) return std::nullopt;
        at += 3;
      }
      if (!add(type, member, count)) return std::nullopt;
    } while (is(at, ","));
    return is(at, ";") ? std::optional(at + 1) : std::nullopt;
  }

  static bool read_count(const std::string& text, std::size_t& count) {
    if (text.size() > 3 || !std::ranges::all_of(text, [](unsigned char c) { return std::isdigit(c); })) return false;
    count = std::stoul(text);
    return count > 0;
  }

  /// `count`: of an array; 0: none.
  bool add(const std::string& type, const std::string& member, std::size_t count) {
    for (std::size_t i = 0; i < std::max<std::size_t>(count, 1); ++i) {
      const std::string path = count > 0 ? fmt::format("{}[{}]", member, i) : member;
      if (floats_.size() >= kMostMembers) return false;
      if (is_float(type))
        floats_.push_back(path);
      else if (!is_whole(type) && !read(type, path + "."))
        return false;
    }
    return true;
  }

  ShaderTokens tokens_;
  std::vector<std::string> floats_;
};

}  // namespace

std::string blend_text(const ShaderSources& sources) {
  MemberReader members(sources);
  if (!members.read("Pattern", "") || members.floats().empty()) return "";
  std::string text = "void redmap_blend(inout Pattern redmap_to, Pattern redmap_from, float redmap_part_) {\n";
  for (const std::string& member : members.floats())
    text += fmt::format("  redmap_to.{0} += (redmap_from.{0} - redmap_to.{0}) * redmap_part_;\n", member);
  return text + "}\n";
}

std::string mixing_text(std::span<const int> groups) {
  const int count = *std::ranges::max_element(groups) + 1;
  std::string mixed, asked;
  std::vector<bool> begun(count);
  for (std::size_t b = 0; b < groups.size(); ++b) {
    const int g = groups[b];
    mixed += begun[g] ? fmt::format(
                            "  redmap_put(redmap_patterns[{0}], redmap_w[{0}], redmap_m.patterns[{1}], "
                            "redmap_m.weights[{1}]);\n",
                            b, g)
                      : fmt::format(
                            "  redmap_m.patterns[{1}] = redmap_patterns[{0}];\n"
                            "  redmap_m.weights[{1}] = redmap_w[{0}];\n",
                            b, g);
    begun[g] = true;
  }
  for (int g = 0; g < count; ++g)
    asked += fmt::format(
        "  redmap_sum += redmap_m.weights[{0}] * radiance(redmap_m.patterns[{0}], redmap_l, redmap_v);\n"
        "  redmap_ended(2u);\n",
        g);
  return (count == 1 ? "#define REDMAP_MIXES_ALL\n" : "") +
         fmt::format(
             "struct RedmapMixed {{\n  Pattern patterns[{0}];\n  float weights[{0}];\n}};\n"
             "void redmap_put(Pattern redmap_one, float redmap_weight, inout Pattern redmap_to, inout float "
             "redmap_total) {{\n"
             "  redmap_total += redmap_weight;\n"
             "  redmap_blend(redmap_to, redmap_one, redmap_weight / max(redmap_total, 1e-12));\n}}\n"
             "RedmapMixed redmap_mixed(float redmap_w[REDMAP_BASIS]) {{\n  RedmapMixed redmap_m;\n{1}  return "
             "redmap_m;\n}}\n"
             "vec3 redmap_of_mixed(RedmapMixed redmap_m, vec3 redmap_l, vec3 redmap_v) {{\n"
             "  vec3 redmap_sum = vec3(0.0);\n{2}  return redmap_sum;\n}}\n",
             count, mixed, asked);
}

}  // namespace redmap
