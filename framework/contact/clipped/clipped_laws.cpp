#include "framework/contact/clipped/clipped_laws.hpp"

#include <algorithm>
#include <array>
#include <memory>

namespace tack {
namespace {

// Difference of two levels per range of the law, below which they are one: round-off.
constexpr double same_level_ratio = 1e-9;

// A law times a factor.
class ScaledLaw final : public NormalLaw {
 public:
  ScaledLaw(std::shared_ptr<const NormalLaw> whole, double factor) : whole_(std::move(whole)), factor_(factor) {}

  std::string_view name() const override { return whole_->name(); }
  void prepare(const PairMaterials&) override {}
  double range() const override { return whole_->range(); }
  void add_samples(int n, const double* gap, LawSample* out) const override {
    for (int first = 0; first < n; first += chunk) {
      const int count = std::min(chunk, n - first);
      std::array<LawSample, chunk> samples{};
      whole_->add_samples(count, gap + first, samples.data());
      for (int i = 0; i < count; ++i) {
        out[first + i].value += factor_ * samples[i].value;
        out[first + i].slope += factor_ * samples[i].slope;
        out[first + i].curvature += factor_ * samples[i].curvature;
      }
    }
  }
  void add_values(int n, const double* gap, double* out) const override {
    for (int first = 0; first < n; first += chunk) {
      const int count = std::min(chunk, n - first);
      std::array<double, chunk> values{};
      whole_->add_values(count, gap + first, values.data());
      for (int i = 0; i < count; ++i) out[first + i] += factor_ * values[i];
    }
  }
  std::unique_ptr<NormalLaw> clone() const override { return std::make_unique<ScaledLaw>(*this); }

 private:
  static constexpr int chunk = 16;  // gaps at a time: those of a pack of pairs

  std::shared_ptr<const NormalLaw> whole_;
  double factor_;
};

void add_scaled(const PairLaw& law, double factor, PairLaw& sum) {
  for (const auto& term : law.laws()) sum.add(std::make_shared<ScaledLaw>(term, factor));
}

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
  add_scaled(laws_[law].law, 0.5, half);
  const int index = add(std::move(half), laws_[law].of_table);
  laws_[index].share = 0.5;
  return half_[law] = index;
}

ClippedLaws ClippedLaws::of_objects(int a, int b) const {
  const int last = a == b ? 0 : 1;
  ClippedLaws own(ObjectClasses::single(last + 1));
  own.laws_ = laws_;
  own.half_ = half_;
  own.differences_ = differences_;
  const auto copy = [&](std::size_t from, std::size_t to) {
    own.laws_of_pair_[to] = laws_of_pair_[from];
    own.planes_[to] = planes_[from];
  };
  copy(classes_.index(a, b), own.classes_.index(0, last));
  copy(classes_.index(b, a), own.classes_.index(last, 0));
  return own;
}

void ClippedLaws::add_differences() {
  for (const std::vector<int>& laws : laws_of_pair_) {
    if (laws.size() < 2 || laws[0] < 0) continue;
    const int of_objects = laws[0];
    for (std::size_t i = 1; i < laws.size(); ++i) {
      if (laws[i] == of_objects || differences_.contains({laws[i], of_objects})) continue;
      PairLaw difference(laws_[of_objects].law.offset());
      GapBands bands = laws_[of_objects].bands;
      if (laws[i] >= 0) {
        add_scaled(laws_[laws[i]].law, 1, difference);
        bands.insert(bands.end(), laws_[laws[i]].bands.begin(), laws_[laws[i]].bands.end());
        std::sort(bands.begin(), bands.end());
        const double same = same_level_ratio * bands.back();
        bands.erase(std::unique(bands.begin(), bands.end(), [&](double a, double b) { return b - a <= same; }), bands.end());
      }
      add_scaled(laws_[of_objects].law, -1, difference);
      const double range = difference.range();
      differences_[{laws[i], of_objects}] = static_cast<int>(laws_.size());
      laws_.push_back({std::move(difference), std::move(bands), range, strip_per_range * (range - laws_[of_objects].law.offset()),
                       laws_[laws[i] >= 0 ? laws[i] : of_objects].of_table});
    }
  }
}

}  // namespace tack
