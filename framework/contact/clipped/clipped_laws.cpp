#include "framework/contact/clipped/clipped_laws.hpp"

#include <memory>

namespace tack {
namespace {

// Half of a law.
class HalfLaw final : public NormalLaw {
 public:
  explicit HalfLaw(std::shared_ptr<const NormalLaw> whole) : whole_(std::move(whole)) {}

  std::string_view name() const override { return whole_->name(); }
  void prepare(const PairMaterials&) override {}
  double range() const override { return whole_->range(); }
  void add_samples(int n, const double* gap, LawSample* out) const override {
    for (int i = 0; i < n; ++i) {
      LawSample sample;
      whole_->add_samples(1, gap + i, &sample);
      out[i].value += 0.5 * sample.value;
      out[i].slope += 0.5 * sample.slope;
      out[i].curvature += 0.5 * sample.curvature;
    }
  }
  void add_values(int n, const double* gap, double* out) const override {
    for (int i = 0; i < n; ++i) {
      double value = 0;
      whole_->add_values(1, gap + i, &value);
      out[i] += 0.5 * value;
    }
  }
  std::unique_ptr<NormalLaw> clone() const override { return std::make_unique<HalfLaw>(*this); }

 private:
  std::shared_ptr<const NormalLaw> whole_;
};

}  // namespace

int ClippedLaws::add(PairLaw law, int of_table) {
  const double range = law.range(), strip = strip_per_range * (range - law.offset());
  GapBands bands = gap_bands(law);
  laws_.push_back({std::move(law), std::move(bands), range, strip, of_table});
  return static_cast<int>(laws_.size()) - 1;
}

int ClippedLaws::half_of(int law) {
  if (const auto found = half_.find(law); found != half_.end()) return found->second;
  PairLaw half(laws_[law].law.offset());
  for (const auto& term : laws_[law].law.laws()) half.add(std::make_shared<HalfLaw>(term));
  const int index = add(std::move(half), laws_[law].of_table);
  laws_[index].share = 0.5;
  return half_[law] = index;
}

}  // namespace tack
