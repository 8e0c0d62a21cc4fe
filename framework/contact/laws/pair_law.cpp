#include "framework/contact/laws/pair_law.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace tack {
namespace {

constexpr int batch_size_max = 64;

// Calls act(first, n, gaps) for batches of the distances.
template <class Act>
void in_gaps(int n, const double* d, double offset, const Act& act) {
  std::array<double, batch_size_max> gap;
  for (int first = 0; first < n; first += batch_size_max) {
    const int count = std::min(batch_size_max, n - first);
    for (int i = 0; i < count; ++i) gap[i] = d[first + i] - offset;
    act(first, count, gap.data());
  }
}

constexpr double infinity = std::numeric_limits<double>::infinity();

// Largest offset over the distance at rest. The remaining gap is the range of the barrier, which is
// shortened with unchanged pressures. The ratio therefore changes no force, only how far two layers
// may approach: by a twentieth of their distance.
constexpr double offset_per_rest_distance_max = 0.95;

// Barrier phi(k g) / k of a barrier phi: its range is k times shorter, with equal pressures.
class ShortenedBarrier final : public NormalLaw {
 public:
  ShortenedBarrier(std::shared_ptr<const NormalLaw> original, double k) : original_(std::move(original)), k_(k) {}

  std::string_view name() const override { return original_->name(); }
  void prepare(const PairMaterials&) override {}
  double range() const override { return original_->range() / k_; }
  void add_samples(int n, const double* gap, LawSample* out) const override {
    in_gaps(n, gap, 0, [&](int first, int count, double* longer) {
      std::array<LawSample, batch_size_max> samples{};
      for (int i = 0; i < count; ++i) longer[i] *= k_;
      original_->add_samples(count, longer, samples.data());
      for (int i = 0; i < count; ++i) {
        out[first + i].value += samples[i].value / k_;
        out[first + i].slope += samples[i].slope;
        out[first + i].curvature += samples[i].curvature * k_;
      }
    });
  }
  void add_values(int n, const double* gap, double* out) const override {
    in_gaps(n, gap, 0, [&](int first, int count, double* longer) {
      std::array<double, batch_size_max> values{};
      for (int i = 0; i < count; ++i) longer[i] *= k_;
      original_->add_values(count, longer, values.data());
      for (int i = 0; i < count; ++i) out[first + i] += values[i] / k_;
    });
  }
  std::unique_ptr<NormalLaw> clone() const override { return std::make_unique<ShortenedBarrier>(*this); }

 private:
  std::shared_ptr<const NormalLaw> original_;
  double k_;
};

bool is_barrier(const NormalLaw& law) { return dynamic_cast<const NormalAdhesion*>(&law) == nullptr; }

}  // namespace

LawTerm law_term(std::string_view name) {
  if (name.empty()) return LawTerm::all;
  return name == "barrier" ? LawTerm::barrier : LawTerm::adhesion;
}

PairLaw PairLaw::only(LawTerm term) const {
  if (term == LawTerm::all) return *this;
  PairLaw chosen(offset_);
  for (const auto& law : laws_)
    if ((dynamic_cast<const NormalAdhesion*>(law.get()) != nullptr) == (term == LawTerm::adhesion)) chosen.add(law);
  return chosen;
}

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

double PairLaw::offset_from_rest(double offset, double distance) { return std::min(offset, offset_per_rest_distance_max * distance); }

PairLaw PairLaw::from_rest(double distance) const {
  PairLaw cut(offset_from_rest(offset_, distance));
  const double remaining = distance - cut.offset();
  for (const auto& law : laws_) {
    if (is_barrier(*law) && law->range() > remaining) cut.add(std::make_shared<ShortenedBarrier>(law, law->range() / remaining));
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
