#include "bake/bake.h"

#include <sys/resource.h>

#include <chrono>
#include <cmath>

#include "analysis/held_out.h"
#include "analysis/hidden_frames.h"
#include "analysis/lobe_fit.h"
#include "bake/normals.h"
#include "bake/passes.h"
#include "bake/project.h"
#include "bake/sample.h"
#include "bake/surface_cells.h"
#include "bake/tangents.h"
#include "bake/texel_grid.h"
#include "bake/verdict.h"
#include "base/parallel.h"
#include "shader/shading_frames.h"

namespace redmap {
namespace {

static_assert(kMaxBasis == kMaxUnknowns && kMaxBasis == kMaxChannels);

/// Largest map: its texels still have 32-bit indices.
constexpr int kMaxSize = 16384;

void validate(const BakeOptions& o) {
  if (o.size < 1 || o.size > kMaxSize) throw Error("bake: size: expected 1 to {}, found {}", kMaxSize, o.size);
  if (!(o.tolerance > 0 && std::isfinite(o.tolerance)))
    throw Error("bake: tolerance: expected a number above 0, found {}", o.tolerance);
  if (o.max_basis < 1 || o.max_basis > kMaxBasis)
    throw Error("bake: max_basis: expected 1 to {}, found {}", kMaxBasis, o.max_basis);
  if (o.sub_samples < 1 || o.sub_samples > 8)
    throw Error("bake: sub_samples: expected 1 to 8, found {}", o.sub_samples);
}

/// Seconds since the last call, into the report.
class Stopwatch {
 public:
  explicit Stopwatch(BakeReport& report) : report_(report) {}
  void lap(const char* stage) {
    const Clock::time_point now = Clock::now();
    report_.stages.push_back({stage, std::chrono::duration<double>(now - last_).count()});
    report_.seconds += report_.stages.back().seconds;
    last_ = now;
  }

 private:
  using Clock = std::chrono::steady_clock;
  BakeReport& report_;
  Clock::time_point last_ = Clock::now();
};

std::uint64_t peak_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

/// The paper has its own table and no other.
DirectionChoice directions_for(const Shader& shader, const SurfacePoints& points, const BakeOptions& options) {
  if (options.selection == BasisSelection::kPaper || points.size() == 0) return {reflection_samples()};
  return choose_directions(*shader.bind(points), options.tolerance, options.max_basis);
}

ReductionMap describe(const Surface& surface, const Shader& shader, const BakeOptions& options,
                      const ChosenBasis& basis) {
  ReductionMap map;
  map.shader = shader.info().name;
  map.shader_hash = shader.info().text_hash;
  for (std::size_t i = 0; i < shader.info().parameters.size(); ++i)
    map.parameters[shader.info().parameters[i].name] = shader.parameters()[i];
  map.surface_fingerprint = surface.fingerprint();
  map.size = options.size;
  map.tolerance = options.tolerance;
  map.residual = basis.residual;
  for (const ReflectancePlace& p : basis.places) map.basis.push_back({p.position, p.normal, p.tangent, p.uv});
  return map;
}

void store_frames(const RevealedShader& shader, ReductionMap& map) {
  map.hides_frames = true;
  const std::vector<Frame> frames = shader.frames(basis_points(map));
  for (std::size_t b = 0; b < frames.size(); ++b)
    map.basis[b].frame_z = frames[b].z, map.basis[b].frame_x = frames[b].x;
}

/// Most points across a texel at which normals are probed for: each takes 33 calls or more.
constexpr int kProbedSubSamples = 2;

/// Normals and tangents of shaders that have their own.
void build_frames(const TexelGrid& grid, const Shader& shader, const BakeOptions& options, const BaseLevel& weights,
                  BakeMonitor& monitor, ReductionMap& map) {
  if (shader.info().perturbs_normals) {
    const int sub_samples = map.hides_frames ? std::min(kProbedSubSamples, options.sub_samples) : options.sub_samples;
    map.normals = NormalPyramid(sample_normals(grid, shader, sub_samples, monitor), map.weights);
  }
  if (shader.info().turns_tangents) {
    BaseLevel tangents = sample_tangents(grid, shader, options, monitor);
    tangents.coverage = weights.coverage;
    map.tangents = WeightPyramid(tangents);
  }
}

void fit_lobes(const Shader& shader, ReductionMap& map) {
  const std::unique_ptr<BoundPatterns> basis = bind_in_frames(shader, basis_points(map), basis_frames(map));
  map.lobes.resize(map.basis.size());
  parallel_for(map.lobes.size(), [&](std::size_t b) { map.lobes[b] = fit_lobes(*basis, b); });
}

}  // namespace

ReductionMap bake(const Surface& surface, const Shader& shader, const BakeOptions& options, BakeReport* report) {
  return bake(surface, shader, options, *make_cpu_passes(), report);
}

ReductionMap bake(const Surface& surface, const Shader& own, const BakeOptions& options, TexelPasses& wanted_passes,
                  BakeReport* report) {
  validate(options);
  BakeReport ours;
  ours.stages.reserve(8);
  Stopwatch stopwatch(ours);
  BakeMonitor monitor(options.progress);

  const TexelGrid grid(surface, options.size);
  const SurfacePoints some = some_points(grid);
  const HiddenFrames hidden = find_hidden_frames(own, some);
  const RevealedShader revealed(own, hidden);
  const Shader& shader = hidden.any() ? static_cast<const Shader&>(revealed) : own;
  const DirectionChoice directions = directions_for(shader, some, options);
  ours.added_directions = directions.added;
  ours.disagreement_of_table = directions.disagreement_of_table, ours.disagreement = directions.disagreement;
  stopwatch.lap("probe");

  // What is revealed runs on the CPU.
  const std::unique_ptr<TexelPasses> cpu_passes = make_cpu_passes();
  TexelPasses& passes = hidden.any() ? *cpu_passes : wanted_passes;

  const BakeJob job{grid, shader, options, directions.directions, monitor};
  SampledTexels sampled = sample_texels(job, passes);
  ours.distinct_reflectances = sampled.unique.distinct();
  stopwatch.lap("sample");

  ChosenBasis basis = choose(sampled, options);
  stopwatch.lap("choose");

  BaseLevel weights = project(job, passes, sampled, basis, ours);
  ours.outlier_basis = basis.outliers;
  stopwatch.lap("project");

  ReductionMap map = describe(surface, shader, options, basis);
  if (hidden.any()) store_frames(revealed, map);
  fit_lobes(own, map);
  map.weights = passes.build_pyramid(weights);
  map.clusters = build_clusters(surface, map.weights);
  stopwatch.lap("build");

  build_frames(grid, shader, options, weights, monitor, map);
  ours.probed_normals = revealed.tally().places, ours.normals_not_found = revealed.tally().not_found;
  stopwatch.lap("normals");

  judge(grid, shader, sampled, map);
  stopwatch.lap("judge");
  monitor.begin("done", 1.0f);
  monitor.advance(1);
  monitor.throw_if_stopped();
  ours.peak_bytes = peak_bytes();
  if (report) *report = ours;
  return map;
}

}  // namespace redmap
