#include "framework/contact/pair_law.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace tack {
namespace {

constexpr int most_at_once = 64;

// Calls act(first, n, gaps) for some of the distances at a time.
template <class Act>
void in_gaps(int n, const double* d, double offset, const Act& act) {
  std::array<double, most_at_once> gap;
  for (int first = 0; first < n; first += most_at_once) {
    const int count = std::min(most_at_once, n - first);
    for (int i = 0; i < count; ++i) gap[i] = d[first + i] - offset;
    act(first, count, gap.data());
  }
}

constexpr double infinity = std::numeric_limits<double>::infinity();

// The largest fraction of a distance at rest that an offset takes. The rest is room to press in. The
// barrier there is shortened with the same pressures, so that the fraction changes no force: only how
// far, in twentieths of the gap, two layers may still approach.
constexpr double filled_at_rest = 0.95;

// phi(k g) / k of a barrier phi: k times shorter, with the same pressures.
class ShortenedBarrier final : public NormalLaw {
 public:
  ShortenedBarrier(std::shared_ptr<const NormalLaw> whole, double k) : whole_(std::move(whole)), k_(k) {}

  std::string_view name() const override { return whole_->name(); }
  void prepare(const PairMaterials&) override {}
  double range() const override { return whole_->range() / k_; }
  void add_samples(int n, const double* gap, LawSample* out) const override {
    in_gaps(n, gap, 0, [&](int first, int count, double* longer) {
      std::array<LawSample, most_at_once> samples{};
      for (int i = 0; i < count; ++i) longer[i] *= k_;
      whole_->add_samples(count, longer, samples.data());
      for (int i = 0; i < count; ++i) {
        out[first + i].value += samples[i].value / k_;
        out[first + i].slope += samples[i].slope;
        out[first + i].curvature += samples[i].curvature * k_;
      }
    });
  }
  void add_values(int n, const double* gap, double* out) const override {
    in_gaps(n, gap, 0, [&](int first, int count, double* longer) {
      std::array<double, most_at_once> values{};
      for (int i = 0; i < count; ++i) longer[i] *= k_;
      whole_->add_values(count, longer, values.data());
      for (int i = 0; i < count; ++i) out[first + i] += values[i] / k_;
    });
  }
  std::unique_ptr<NormalLaw> clone() const override { return std::make_unique<ShortenedBarrier>(*this); }

 private:
  std::shared_ptr<const NormalLaw> whole_;
  double k_;
};

bool is_barrier(const NormalLaw& law) { return dynamic_cast<const NormalAdhesion*>(&law) == nullptr; }

}  // namespace

double PairLaw::range() const {
  double range = 0;
  for (const auto& law : laws_) range = std::max(range, law->range());
  return range > 0 ? range + offset_ : 0;
}

double PairLaw::barrier_range() const {
  double range = 0;
  for (const auto& law : laws_)
    if (is_barrier(*law)) range = std::max(range, law->range());
  return range;
}

double PairLaw::offset_from_rest(double offset, double distance) { return std::min(offset, filled_at_rest * distance); }

PairLaw PairLaw::from_rest(double distance) const {
  PairLaw cut(offset_from_rest(offset_, distance));
  const double room = distance - cut.offset();
  for (const auto& law : laws_) {
    if (is_barrier(*law) && law->range() > room) cut.add(std::make_shared<ShortenedBarrier>(law, law->range() / room));
    else cut.add(law);
  }
  return cut;
}

void PairLaw::gap_samples(int n, const double* gap, LawSample* out) const {
  std::fill(out, out + n, LawSample{});
  for (const auto& law : laws_) law->add_samples(n, gap, out);
}

void PairLaw::samples(int n, const double* d, LawSample* out) const {
  if (offset_ == 0) return gap_samples(n, d, out);
  in_gaps(n, d, offset_, [&](int first, int count, const double* gap) {
    gap_samples(count, gap, out + first);
    for (int i = 0; i < count; ++i)
      if (gap[i] <= 0) out[first + i] = {infinity, -infinity, infinity};
  });
}

void PairLaw::values(int n, const double* d, double* out) const {
  const auto add = [&](int count, const double* gap, double* sum) {
    std::fill(sum, sum + count, 0.0);
    for (const auto& law : laws_) law->add_values(count, gap, sum);
  };
  if (offset_ == 0) return add(n, d, out);
  in_gaps(n, d, offset_, [&](int first, int count, const double* gap) {
    add(count, gap, out + first);
    for (int i = 0; i < count; ++i)
      if (gap[i] <= 0) out[first + i] = infinity;
  });
}

LawSample PairLaw::at(double d) const {
  LawSample sample;
  samples(1, &d, &sample);
  return sample;
}

PairLaw::Well PairLaw::well() const {
  // A scan on a logarithmic grid brackets the lowest point; golden section refines it.
  constexpr int points = 2000;
  constexpr double smallest = 1e-6;  // of the range
  const double end = range() - offset_;
  const auto gap = [&](double u) { return end * std::pow(smallest, 1 - u); };
  const auto phi = [&](double u) { return at(gap(u) + offset_).value; };
  int best = points;
  double lowest = phi(1);
  for (int i = 0; i < points; ++i)
    if (const double value = phi(i / double(points)); value < lowest) best = i, lowest = value;
  if (best == points) return {};
  double a = std::max(best - 1, 0) / double(points), b = (best + 1) / double(points);
  const double ratio = (std::sqrt(5.0) - 1) / 2;
  for (int i = 0; i < 80; ++i) {
    const double c = b - ratio * (b - a), d = a + ratio * (b - a);
    (phi(c) < phi(d) ? b : a) = phi(c) < phi(d) ? d : c;
  }
  const double u = (a + b) / 2;
  return {std::max(0.0, -phi(u)), gap(u)};
}

}  // namespace tack
