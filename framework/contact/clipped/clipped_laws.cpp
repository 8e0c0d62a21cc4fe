#include "framework/contact/clipped/clipped_laws.hpp"

#include <algorithm>
#include <array>
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
    for (int first = 0; first < n; first += chunk) {
      const int count = std::min(chunk, n - first);
      std::array<LawSample, chunk> samples{};
      whole_->add_samples(count, gap + first, samples.data());
      for (int i = 0; i < count; ++i) {
        out[first + i].value += 0.5 * samples[i].value;
        out[first + i].slope += 0.5 * samples[i].slope;
        out[first + i].curvature += 0.5 * samples[i].curvature;
      }
    }
  }
  void add_values(int n, const double* gap, double* out) const override {
    for (int first = 0; first < n; first += chunk) {
      const int count = std::min(chunk, n - first);
      std::array<double, chunk> values{};
      whole_->add_values(count, gap + first, values.data());
      for (int i = 0; i < count; ++i) out[first + i] += 0.5 * values[i];
    }
  }
  std::unique_ptr<NormalLaw> clone() const override { return std::make_unique<HalfLaw>(*this); }

 private:
  static constexpr int chunk = 16;  // gaps at a time: those of a pack of pairs

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

ClippedLaws ClippedLaws::of_objects(int a, int b) const {
  const int last = a == b ? 0 : 1;
  ClippedLaws own(ObjectClasses::single(last + 1));
  own.laws_ = laws_;
  own.half_ = half_;
  const auto copy = [&](std::size_t from, std::size_t to) {
    own.laws_of_pair_[to] = laws_of_pair_[from];
    own.planes_[to] = planes_[from];
  };
  copy(classes_.index(a, b), own.classes_.index(0, last));
  copy(classes_.index(b, a), own.classes_.index(last, 0));
  return own;
}

}  // namespace tack
