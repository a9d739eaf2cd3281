#include "verify/weight_probe.h"

namespace redmap {

namespace {

class ProbePatterns : public BoundPatterns {
 public:
  ProbePatterns(std::size_t size, int first) : size_(size), first_(first) {}
  std::size_t size() const override { return size_; }
  void radiance_each(const DirectionPairs&, Planes<3>& out) const override { out = Planes<3>(size_); }
  void radiance_one(std::size_t, const DirectionPairs& pairs, Planes<3>& out) const override {
    out = Planes<3>(pairs.size());
  }
  void radiance_all(const DirectionPairs& pairs, LaneVector<float>& out) const override {
    out.assign(pairs.size() * 3 * padded(size_), 0.0f);
  }
  void transmittance(Planes<3>& out) const override { out = Planes<3>(size_); }
  void emission(Planes<3>& out) const override {
    out = Planes<3>(size_);
    for (std::size_t c = 0; c < kProbedWeights && first_ + c < size_; ++c) out[static_cast<int>(c)][first_ + c] = 1;
  }
  bool materials(Materials&) const override { return false; }

 private:
  std::size_t size_;
  std::size_t first_;
};

class ProbeShader : public Shader {
 public:
  explicit ProbeShader(int first) : first_(first) { info_.name = "weights", info_.emits = true; }
  const ShaderInfo& info() const override { return info_; }
  const ParameterValues& parameters() const override { return parameters_; }
  std::unique_ptr<BoundPatterns> bind(const SurfacePoints& points) const override {
    return std::make_unique<ProbePatterns>(points.size(), first_);
  }

 private:
  int first_;
  ShaderInfo info_;
  ParameterValues parameters_;
};

}  // namespace

std::shared_ptr<const Shader> make_weight_probe(int first) { return std::make_shared<ProbeShader>(first); }

}  // namespace redmap
