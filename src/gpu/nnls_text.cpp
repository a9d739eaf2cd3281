#include "gpu/nnls_text.h"

#include <fmt/format.h>

#include <sstream>

namespace redmap {
namespace {

std::string replaced(std::string text, std::string_view from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

/// Gradients below that part of the product, and pivots below that part of the diagonal, are zero: as in nnls.cpp, or
/// a digit above what 32 bits leave of them.
std::string precision(bool has_doubles) {
  return fmt::format(
      "#define redmap_real {}\n"
      "#define redmap_real3 {}\n"
      "const redmap_real redmap_gradient_tolerance = redmap_real({});\n"
      "const redmap_real redmap_pivot_tolerance = redmap_real({});\n",
      has_doubles ? "double" : "float", has_doubles ? "dvec3" : "vec3", has_doubles ? "1e-10" : "1e-5",
      has_doubles ? "1e-13" : "1e-5");
}

constexpr std::string_view kTypes = R"(
struct RedmapProducts {
  redmap_real own;
  redmap_real of$;
};
struct RedmapWeights {
  redmap_real of$;
};
)";

/// Between them stands the factorisation.
constexpr std::string_view kSolveBegin = R"(
RedmapWeights redmap_solve(RedmapProducts redmap_p) {
  RedmapWeights redmap_w;
  redmap_w.of$ = redmap_real(0.0);
  uint redmap_passive = 0u, redmap_barred = 0u;
  // Every round lowers the residual; the bound is for rounding alone.
  for (int redmap_round = 0; redmap_round < 4 * $K; redmap_round++) {
    // What would help most if it grew.
    uint redmap_entering = 0u;
    redmap_real redmap_best = redmap_real(0.0);
    redmap_real redmap_gradient = redmap_real(0.0);
)";
constexpr std::string_view kSolveStep = R"(
    if (redmap_entering == 0u) break;
    redmap_passive |= redmap_entering;
    for (int redmap_step = 0; redmap_step <= $K; redmap_step++) {
      bool redmap_whole = true;
)";
constexpr std::string_view kSolveEnd = R"(
      if (!redmap_whole) {
        // What the others span already adds nothing: it is left out for good.
        redmap_barred |= redmap_entering;
        redmap_passive &= ~redmap_entering;
        if (redmap_entering == 1u << $) redmap_w.of$ = redmap_real(0.0);
        break;
      }
      // Towards the solution as far as nothing becomes negative.
      redmap_real redmap_part = redmap_real(1.0);
      uint redmap_blocking = 0u;
      redmap_real redmap_reach;
      if ((redmap_passive >> $ & 1u) != 0u && !(redmap_x$ > redmap_real(0.0))) { redmap_reach = redmap_w.of$ / max(redmap_w.of$ - redmap_x$, redmap_real(1e-30)); if (redmap_blocking == 0u || redmap_reach < redmap_part) { redmap_part = redmap_reach; redmap_blocking = 1u << $; } }
      if ((redmap_passive >> $ & 1u) != 0u) redmap_w.of$ = max(redmap_real(0.0), redmap_w.of$ + redmap_part * (redmap_x$ - redmap_w.of$));
      if (redmap_blocking == 0u) break;
      if (redmap_blocking == 1u << $) redmap_w.of$ = redmap_real(0.0);
      if (redmap_w.of$ <= redmap_real(0.0)) redmap_passive &= ~(1u << $);
    }
  }
  return redmap_w;
}

redmap_real redmap_residual_square(RedmapProducts redmap_p, RedmapWeights redmap_w) {
  redmap_real redmap_square = redmap_p.own;
)";

/// The Gram matrix, element by element.
class GramText {
 public:
  GramText(const ReflectanceBasis& basis, bool has_doubles) : basis_(basis), has_doubles_(has_doubles) {}
  int size() const { return basis_.size(); }
  std::string at(int i, int j) const {
    return has_doubles_ ? fmt::format("{:.17e}lf", basis_.gram(i, j)) : fmt::format("{:.9e}", basis_.gram(i, j));
  }
  /// Row i times the weights.
  std::string times_weights(int i) const {
    std::string sum;
    for (int j = 0; j < size(); ++j) sum += fmt::format("{}{} * redmap_w.of{}", j ? " + " : "", at(i, j), j);
    return sum;
  }

 private:
  const ReflectanceBasis& basis_;
  bool has_doubles_;
};

std::string steepest_unknown(const GramText& gram) {
  std::string text;
  for (int i = 0; i < gram.size(); ++i) {
    text += fmt::format("    redmap_gradient = redmap_p.of{} - ({});\n", i, gram.times_weights(i));
    text += fmt::format(
        "    if (((redmap_passive | redmap_barred) >> {0} & 1u) == 0u && redmap_gradient > redmap_best && "
        "redmap_gradient > redmap_gradient_tolerance * abs(redmap_p.of{0})) {{ redmap_best = redmap_gradient; "
        "redmap_entering = 1u << {0}; }}\n",
        i);
  }
  return text;
}

/// Row i of the factorisation, and of the solution forwards.
std::string factor_row(const GramText& gram, int i) {
  std::string text = fmt::format("      bool redmap_a{0} = (redmap_passive >> {0} & 1u) != 0u;\n", i);
  const auto rest = [&](int j) {
    std::string sum = gram.at(i, j);
    for (int q = 0; q < j; ++q) sum += fmt::format(" - redmap_l{}_{} * redmap_l{}_{}", i, q, j, q);
    return sum;
  };
  for (int j = 0; j < i; ++j)
    text += fmt::format("      redmap_real redmap_l{0}_{1} = redmap_a{0} ? ({2}) * redmap_i{1} : redmap_real(0.0);\n",
                        i, j, rest(j));
  text += fmt::format(
      "      redmap_real redmap_d{0} = {1};\n"
      "      redmap_whole = redmap_whole && (!redmap_a{0} || redmap_d{0} > redmap_pivot_tolerance * {2});\n"
      "      redmap_real redmap_i{0} = redmap_a{0} ? redmap_real(1.0) / sqrt(max(redmap_d{0}, redmap_real(1e-30))) : "
      "redmap_real(0.0);\n",
      i, rest(i), gram.at(i, i));
  std::string sum = fmt::format("redmap_p.of{}", i);
  for (int q = 0; q < i; ++q) sum += fmt::format(" - redmap_l{}_{} * redmap_y{}", i, q, q);
  return text + fmt::format("      redmap_real redmap_y{0} = ({1}) * redmap_i{0};\n", i, sum);
}

/// Least squares over the passive unknowns, by Cholesky factorisation. For the others the inverse pivot is zero, and so
/// is what is multiplied by it.
std::string solve_passive(const GramText& gram) {
  std::string text;
  for (int i = 0; i < gram.size(); ++i) text += factor_row(gram, i);
  for (int i = gram.size() - 1; i >= 0; --i) {
    std::string sum = fmt::format("redmap_y{}", i);
    for (int q = i + 1; q < gram.size(); ++q) sum += fmt::format(" - redmap_l{}_{} * redmap_x{}", q, i, q);
    text += fmt::format("      redmap_real redmap_x{0} = ({1}) * redmap_i{0};\n", i, sum);
  }
  return text;
}

std::string residual_square(const GramText& gram) {
  std::string text;
  for (int i = 0; i < gram.size(); ++i)
    text += fmt::format("  redmap_square += redmap_w.of{0} * (({1}) - redmap_real(2.0) * redmap_p.of{0});\n", i,
                        gram.times_weights(i));
  return text + "  return redmap_square;\n}\n";
}

}  // namespace

std::string for_each_of_basis(std::string_view text, int basis) {
  std::string result;
  std::istringstream stream{std::string(text)};
  for (std::string line; std::getline(stream, line);) {
    line = replaced(line, "$K", std::to_string(basis));
    const int times = line.find('$') == std::string::npos ? 1 : basis;
    for (int i = 0; i < times; ++i) result += replaced(line, "$", std::to_string(i)) + "\n";
  }
  return result;
}

std::string nnls_text(const ReflectanceBasis& basis, bool has_doubles) {
  const GramText gram(basis, has_doubles);
  const int size = basis.size();
  return precision(has_doubles) + for_each_of_basis(kTypes, size) + for_each_of_basis(kSolveBegin, size) +
         steepest_unknown(gram) + for_each_of_basis(kSolveStep, size) + solve_passive(gram) +
         for_each_of_basis(kSolveEnd, size) + residual_square(gram);
}

}  // namespace redmap
