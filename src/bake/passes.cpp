#include "bake/passes.h"

#include "bake/project.h"
#include "bake/sample.h"

namespace redmap {
namespace {

class CpuPasses final : public TexelPasses {
 public:
  void sample(const BakeJob& job, SampledTexels& sampled) override { sample_on_cpu(job, sampled); }
  ProjectedPoints average(const BakeJob& job, const SampledTexels& sampled, const ChosenBasis& basis,
                          const KnownWeights& known, std::span<const std::uint8_t> wanted, int sub_samples,
                          BaseLevel& base) override {
    return average_on_cpu(job, sampled, basis, known, wanted, sub_samples, base);
  }
  WeightPyramid build_pyramid(const BaseLevel& base) override { return WeightPyramid(base); }
};

}  // namespace

std::unique_ptr<TexelPasses> make_cpu_passes() { return std::make_unique<CpuPasses>(); }

}  // namespace redmap
