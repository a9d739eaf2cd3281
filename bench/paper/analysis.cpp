// What the paper asserts about its analysis (section 4.2) and does not measure: how many directions, PCA or NNLS, how
// large a block, how many bits a weight.
#include <fmt/format.h>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <chrono>
#include <cmath>

#include "analysis/held_out.h"
#include "figures.h"
#include "reflectance_grid.h"

namespace redmap::bench {

namespace {

constexpr float kTolerance = 0.025f;
constexpr int kMaxBasis = 8;
const char* const kShaders[] = {"scales", "marble", "wood", "layered_rock", "granite"};

int grid_side(Laboratory& laboratory) { return laboratory.samples(256, 128); }

ReflectanceGrid grid_of(Laboratory& laboratory, const std::string& shader, const DirectionPairs& directions) {
  return sample_grid(*laboratory.surface("bunny"), *make_library_shader(shader), grid_side(laboratory), directions);
}

/// Weights that were fitted on `seen`, tried on directions that were held out.
FitErrors try_on(const ReflectanceGrid& seen, const ReflectanceGrid& held_out, const std::vector<std::size_t>& chosen) {
  const ReflectanceBasis basis = basis_of(seen, chosen);
  FitErrors errors;
  BasisWeights weights;
  for (std::size_t i = 0; i < seen.places(); ++i) {
    basis.fit(seen[i], weights);
    double square = 0;
    for (int r = 0; r < held_out.rows; ++r) {
      double difference = held_out[i][r];
      for (std::size_t b = 0; b < chosen.size(); ++b) difference -= weights[b] * held_out[chosen[b]][r];
      square += difference * difference;
    }
    square /= held_out.rows;
    errors.rms += square, errors.largest = std::max(errors.largest, std::sqrt(square));
  }
  errors.rms = std::sqrt(errors.rms / static_cast<double>(seen.places()));
  return errors;
}

/// Principal components of the places, uncentred: the best subspaces. Largest first.
std::vector<Eigen::VectorXd> principal_components(const ReflectanceGrid& grid, int count) {
  Eigen::MatrixXd products = Eigen::MatrixXd::Zero(grid.rows, grid.rows);
  for (std::size_t i = 0; i < grid.places(); ++i) {
    const Eigen::VectorXd v = Eigen::Map<const Eigen::VectorXf>(grid[i], grid.rows).cast<double>();
    products.selfadjointView<Eigen::Lower>().rankUpdate(v);
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(products);
  std::vector<Eigen::VectorXd> components;
  for (int i = 0; i < count; ++i) {
    Eigen::VectorXd component = solver.eigenvectors().col(grid.rows - 1 - i);
    components.push_back(component.sum() < 0 ? Eigen::VectorXd(-component) : component);
  }
  return components;
}

/// Residuals of projections onto the components, weights of either sign.
double signed_residual(const ReflectanceGrid& grid, const std::vector<Eigen::VectorXd>& components) {
  double sum = 0;
  for (std::size_t i = 0; i < grid.places(); ++i) {
    Eigen::VectorXd v = Eigen::Map<const Eigen::VectorXf>(grid[i], grid.rows).cast<double>();
    for (const Eigen::VectorXd& c : components) v -= c.dot(v) * c;
    sum += v.squaredNorm() / grid.rows;
  }
  return std::sqrt(sum / static_cast<double>(grid.places()));
}

/// Light at 30 and viewer at 75 degrees on the other side, away from the highlight: its place in the paper's table.
constexpr int kDullSample = 12;

/// Radiance of a scaled vector there, its largest channel 1.
std::string colour_of(const ReflectanceGrid& grid, const float* scaled) {
  const auto row = [&](int channel) {
    return scaled[3 * kDullSample + channel] / grid.scales[3 * kDullSample + channel];
  };
  const Rgb c{row(0), row(1), row(2)};
  const float largest = std::max({std::abs(c.r), std::abs(c.g), std::abs(c.b), 1e-6f});
  return fmt::format("{:.2f} {:.2f} {:.2f}", c.r / largest, c.g / largest, c.b / largest);
}

}  // namespace

Table measure_directions(Laboratory& laboratory) {
  Table table{"directions",
              "Directions that a reflectance is sampled in, and what is left in 128 others",
              {{"shader", "shader"},
               {"directions", "directions"},
               {"basis", "k"},
               {"residual", "RMS residual, seen"},
               {"held_out_rms", "held out, RMS"},
               {"held_out_worst", "held out, worst place"}},
              {}};
  const DirectionPairs paper = reflection_samples(), more = held_out_samples(1);
  const auto count = static_cast<int>(paper.to_light.size());
  for (const char* shader : kShaders) {
    const ReflectanceGrid held_out = grid_of(laboratory, shader, held_out_samples(2));
    for (const int directions : {4, 8, 16, count, 2 * count, 4 * count}) {
      const ReflectanceGrid seen =
          grid_of(laboratory, shader,
                  directions <= count ? some_of(paper, directions) : joined(paper, some_of(more, directions - count)));
      const BasisChoice choice = choose_basis(seen.vectors(), kTolerance, kMaxBasis);
      const FitErrors fit = fit_all(seen, basis_of(seen, choice.chosen)), tried = try_on(seen, held_out, choice.chosen);
      table.rows.push_back({std::string(shader), static_cast<double>(directions),
                            static_cast<double>(choice.chosen.size()), fit.rms, tried.rms, tried.largest});
    }
  }
  return table;
}

Table measure_pca(Laboratory& laboratory) {
  Table table{"pca",
              "Principal components against places that are chosen, RMS residual",
              {{"shader", "shader"},
               {"basis", "k"},
               {"chosen", "places, weights from nil up (ours)"},
               {"components_signed", "components, weights of either sign"},
               {"components", "components, weights from nil up"}},
              {}};
  for (const char* shader : kShaders) {
    const ReflectanceGrid grid = grid_of(laboratory, shader, reflection_samples());
    const BasisChoice choice = choose_basis(grid.vectors(), kTolerance, kMaxBasis);
    const auto components = principal_components(grid, static_cast<int>(choice.chosen.size()));
    ReflectanceBasis of_components(grid.rows);
    for (const Eigen::VectorXd& component : components) {
      const Eigen::VectorXf values = (component * std::sqrt(grid.rows)).cast<float>();
      of_components.add(values.data());
    }
    table.rows.push_back({std::string(shader), static_cast<double>(choice.chosen.size()),
                          fit_all(grid, basis_of(grid, choice.chosen)).rms, signed_residual(grid, components),
                          fit_all(grid, of_components).rms});
  }
  return table;
}

Table measure_pca_colours(Laboratory& laboratory) {
  Table table{"colours",
              "A checkerboard of red and green: colours of the basis away from its highlight, the largest channel 1",
              {{"method", "method"}, {"first", "first"}, {"second", "second"}},
              {}};
  const auto shader = make_library_shader("checker", {{"dark", {0.8f, 0.05f, 0.05f}},
                                                      {"light", {0.05f, 0.8f, 0.05f}},
                                                      {"dark_exponent", {20}},
                                                      {"light_exponent", {20}}});
  const ReflectanceGrid grid =
      sample_grid(*laboratory.surface("bunny"), *shader, grid_side(laboratory), reflection_samples());
  const BasisChoice choice = choose_basis(grid.vectors(), kTolerance, 2);
  const auto components = principal_components(grid, 2);
  const auto component = [&](int i) {
    const Eigen::VectorXf values = components[i].cast<float>();
    return colour_of(grid, values.data());
  };
  const auto chosen = [&](std::size_t i) {
    return i < choice.chosen.size() ? colour_of(grid, grid[choice.chosen[i]]) : std::string("-");
  };
  table.rows.push_back({std::string("principal components"), component(0), component(1)});
  table.rows.push_back({std::string("non-negative least squares (ours)"), chosen(0), chosen(1)});
  return table;
}

Table measure_blocks(Laboratory& laboratory) {
  Table table{"blocks",
              "Three reflectances of every block, then among those (the paper: 32 x 32); 0: all at once (ours)",
              {{"shader", "shader"},
               {"block", "texels across a block"},
               {"basis", "k"},
               {"residual", "RMS residual"},
               {"largest", "largest"},
               {"seconds", "seconds"}},
              {}};
  for (const char* shader : kShaders) {
    const ReflectanceGrid grid = grid_of(laboratory, shader, reflection_samples());
    for (const int block : {0, 8, 16, 32, 64, 128}) {
      const auto start = std::chrono::steady_clock::now();
      std::vector<std::size_t> handed_on;
      const int across = block ? (grid.side + block - 1) / block : 1;
      std::vector<std::vector<std::size_t>> members(static_cast<std::size_t>(across) * across);
      for (std::size_t i = 0; i < grid.places(); ++i) {
        const int x = static_cast<int>(grid.texel[i]) % grid.side, y = static_cast<int>(grid.texel[i]) / grid.side;
        members[block ? (y / block) * across + x / block : 0].push_back(i);
      }
      for (const auto& places : members) {
        std::vector<float> values;
        for (const std::size_t place : places) values.insert(values.end(), grid[place], grid[place] + grid.rows);
        if (places.empty()) continue;
        for (const std::size_t i :
             choose_basis({values, grid.rows}, kTolerance, block ? kPaperPerBlock : kMaxBasis).chosen)
          handed_on.push_back(places[i]);
      }
      std::vector<float> values;
      for (const std::size_t place : handed_on) values.insert(values.end(), grid[place], grid[place] + grid.rows);
      std::vector<std::size_t> chosen;
      for (const std::size_t i : choose_basis({values, grid.rows}, kTolerance, kMaxBasis).chosen)
        chosen.push_back(handed_on[i]);
      const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      const FitErrors errors = fit_all(grid, basis_of(grid, chosen));
      table.rows.push_back({std::string(shader), static_cast<double>(block), static_cast<double>(chosen.size()),
                            errors.rms, errors.largest, seconds});
    }
  }
  return table;
}

Table measure_bits(Laboratory& laboratory) {
  Table table{"bits",
              "Bits a weight: RMS difference from weights that are not rounded (the paper: 8 bits)",
              {{"shader", "shader"},
               {"bits_2", "2"},
               {"bits_4", "4"},
               {"bits_6", "6"},
               {"bits_8", "8"},
               {"bits_12", "12"},
               {"residual", "residual of the basis"}},
              {}};
  for (const char* shader : kShaders) {
    const ReflectanceGrid grid = grid_of(laboratory, shader, reflection_samples());
    const BasisChoice choice = choose_basis(grid.vectors(), kTolerance, kMaxBasis);
    const ReflectanceBasis basis = basis_of(grid, choice.chosen);
    std::vector<BasisWeights> weights(grid.places());
    BasisWeights largest{};
    for (std::size_t i = 0; i < grid.places(); ++i) {
      basis.fit(grid[i], weights[i]);
      for (int b = 0; b < basis.size(); ++b) largest[b] = std::max(largest[b], weights[i][b]);
    }
    std::vector<Value> row{std::string(shader)};
    for (const int bits : {2, 4, 6, 8, 12}) {
      const float steps = static_cast<float>((1 << bits) - 1);
      double sum = 0;
      for (const BasisWeights& exact : weights) {
        BasisWeights rounded{};
        for (int b = 0; b < basis.size(); ++b)
          if (largest[b] > 0) rounded[b] = std::round(exact[b] / largest[b] * steps) / steps * largest[b];
        const double difference = basis.distance(exact.data(), rounded.data());
        sum += difference * difference;
      }
      row.emplace_back(std::sqrt(sum / static_cast<double>(weights.size())));
    }
    row.emplace_back(fit_all(grid, basis).rms);
    table.rows.push_back(std::move(row));
  }
  return table;
}

Figure measure_analysis(Laboratory& laboratory) {
  Figure figure;
  figure.title = "What the paper asserts about its analysis";
  figure.paper =
      "35 directions are a balance between speed and accuracy; PCA finds yellow where non-negative least squares find "
      "red and green; blocks are typically 32 x 32; a weight is a byte. Not measured there.";
  figure.ours =
      "Reflectances of a grid of places on the bunny, every row scaled to unit RMS, so that .025 is 2.5 % of a typical "
      "value. The table has 34 pairs of directions; the 35th sample is light from behind.";
  int done = 0;
  for (auto* measure : {measure_directions, measure_pca, measure_pca_colours, measure_blocks, measure_bits}) {
    laboratory.step(done++ / 5.0);
    figure.tables.push_back(measure(laboratory));
  }
  return figure;
}

}  // namespace redmap::bench
