// Every barrier and adhesion, with every form, whatever laws exist.
#include <catch2/catch.hpp>
#include <cmath>
#include <optional>

#include "framework/contact/normal_law.hpp"
#include "tests/support/component_variants.hpp"
#include "tests/support/dense_term.hpp"

using namespace tack;

namespace {

const std::vector<std::map<std::string, std::string>> strengths = {
    {},
    {{"critical_strain", "0.5"}},
    {{"critical_strain", "0.3"}, {"peak_distance", "1.2e-3"}, {"range", "1.7e-3"}},
    {{"peak_traction", "3e3"}, {"work_of_adhesion", "9"}},
    {{"work_of_adhesion", "2"}},
    {{"peak_traction", "1e4"}, {"spread", "0.3"}},
    {{"file", TACK_TEST_DATA "/laws/six_rows.csv"}},
    {{"traction", "2e12 * d * (4e-3 - d)^2"}, {"range", "4 mm"}}};

const std::vector<PairMaterials> pairs = {{1e-3, 1e4, 0}, {1e-3, 1e6, 3e3}, {0.7e-3, 3e4, 1e9}};

// Calls check(law, pair) for every variant and pair; adhesions only if they are laws of the gap.
template <class Base, class Sort = Base, class Check>
void for_each_law(const Check& check) {
  const auto all = variants<Base, Sort>(strengths);
  for (const ComponentVariant& variant : all) {
    for (const PairMaterials& pair : pairs) {
      const auto law = component<Base>(variant.yaml);
      law->prepare(pair);
      INFO(variant.yaml << " at a contact distance of " << pair.contact_distance << " m");
      check(dynamic_cast<const Sort&>(*law), pair);
    }
  }
}

// The gap below the range at which phi'' jumps, if there is one: where it changes most, looked at ever more closely.
std::optional<double> inner_kink(const NormalLaw& law) {
  double low = 1e-3 * law.range(), high = (1 - 1e-9) * law.range(), change = 0, whole = 0;
  for (const double u : {0.3, 0.5, 0.7, 0.8, 0.97}) whole = std::max(whole, std::abs(law.at(u * law.range()).curvature));
  for (int parts = 4096; high - low > 1e-15 * law.range(); parts = 4) {
    const double width = (high - low) / parts, from = low;
    change = 0;
    for (int i = 0; i < parts; ++i) {
      const double a = from + i * width, here = std::abs(law.at(a + width).curvature - law.at(a).curvature);
      if (here >= change) change = here, low = a;
    }
    const double before = high - from;
    high = std::min(low + width, high);
    if (high - low >= before) break;  // neighbours among numbers
  }
  if (change < 1e-3 * whole) return std::nullopt;
  return 0.5 * (low + high);
}

// Gaps at which phi'' jumps, ascending, the range included.
std::vector<double> kinks_of(const NormalLaw& law) {
  const auto inner = inner_kink(law);
  return inner ? std::vector{*inner, law.range()} : std::vector{law.range()};
}

// The ends of the intervals on which a law is smooth: 0, the kinks.
std::vector<double> ends_of(const NormalLaw& law) {
  std::vector<double> ends = kinks_of(law);
  ends.insert(ends.begin(), 0.0);
  return ends;
}

void check_derivatives_at(const NormalLaw& law, double d, double h) {
  INFO("gap " << d << " m");
  const LawSample s = law.at(d);
  const auto value = [&](double e) { return law.at(d + e).value; };
  const auto slope = [&](double e) { return law.at(d + e).slope; };
  const double value_rounding = 1e-14 * (std::abs(value(h)) + std::abs(value(-h))) / h;
  const double slope_rounding = 1e-14 * (std::abs(slope(h)) + std::abs(slope(-h))) / h;
  CHECK(std::abs(central_difference(value, h) - s.slope) <= 1e-7 * std::abs(s.slope) + value_rounding);
  CHECK(std::abs(central_difference(slope, h) - s.curvature) <=
        1e-7 * std::abs(s.curvature) + slope_rounding + 1e-7 * std::abs(s.slope) / d);
  double batched = 0;
  law.add_values(1, &d, &batched);
  CHECK(std::abs(batched - s.value) <= 1e-13 * (std::abs(s.value) + d * std::abs(s.slope)));
}

void check_derivatives(const NormalLaw& law) {
  const auto ends = ends_of(law);
  for (size_t i = 0; i + 1 < ends.size(); ++i) {
    REQUIRE(ends[i] < ends[i + 1]);
    const double length = ends[i + 1] - ends[i];
    for (const double u : {1e-3, 0.01, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99, 0.999})
      check_derivatives_at(law, ends[i] + u * length, 0.005 * std::min(u, 1 - u) * length);
  }
}

// Value and slope do not jump.
void check_continuity(const NormalLaw& law) {
  for (const double kink : kinks_of(law)) {
    INFO("kink at " << kink << " m");
    const double e = 1e-7 * kink;
    const LawSample low = law.at(kink - e), high = law.at(kink + e);
    const double slope = std::abs(low.slope) + std::abs(high.slope);
    CHECK(std::abs(high.slope - low.slope) <=
          2 * e * (std::abs(low.curvature) + std::abs(high.curvature)) + 1e-12 * slope);
    CHECK(std::abs(high.value - low.value) <= 2 * e * slope + 1e-13 * std::abs(low.value));
  }
}

void check_end(const NormalLaw& law) {
  const double range = law.range();
  for (const double d : {range, 1.001 * range, 10 * range, 1e3}) {
    const LawSample s = law.at(d);
    CHECK((s.value == 0 && s.slope == 0 && s.curvature == 0));
  }
  for (const double e : {1e-3 * range, 1e-5 * range}) {  // value and slope fade towards the end
    const LawSample s = law.at(range - e);
    CHECK(s.value != 0);
    CHECK(std::abs(s.slope) <= 1.1 * e * std::abs(s.curvature));
    CHECK(std::abs(s.value) <= 1.1 * e * std::abs(s.slope));
  }
}

void check_clone(const NormalLaw& law) {
  const auto copy = law.clone();
  CHECK(copy->range() == law.range());
  const double d = 0.4 * law.range();
  CHECK(copy->at(d).value == law.at(d).value);
  LawSample twice = law.at(d);
  law.add_samples(1, &d, &twice);
  CHECK(twice.slope == 2 * law.at(d).slope);
}

}  // namespace

TEST_CASE("barriers: derivatives, kinks and end", "[laws]") {
  for_each_law<BarrierLaw>([](const BarrierLaw& law, const PairMaterials& pair) {
    CHECK(law.range() == Approx(pair.contact_distance));
    check_derivatives(law);
    check_continuity(law);
    check_end(law);
    check_clone(law);
  });
}

TEST_CASE("adhesions: derivatives, kinks and end", "[laws]") {
  for_each_law<AdhesionLaw, NormalAdhesion>([](const NormalAdhesion& law, const PairMaterials& pair) {
    CHECK(law.range() > pair.contact_distance);
    check_derivatives(law);
    check_continuity(law);
    check_end(law);
    check_clone(law);
  });
}

TEST_CASE("barriers repel, and without bound as the gap closes", "[laws]") {
  for_each_law<BarrierLaw>([](const BarrierLaw& law, const PairMaterials&) {
    for (int i = 1; i < 1000; ++i) {
      const LawSample s = law.at(law.range() * i / 1000.0);
      REQUIRE(s.value > 0);
      REQUIRE(s.slope < 0);
    }
    // From gap to squared gap the value grows at least as much as before, so it is unbounded.
    double before = 0, growth = 0;
    for (const double u : {1e-2, 1e-4, 1e-8, 1e-16, 1e-32}) {
      const double value = law.at(u * law.range()).value;
      CHECK(value - before >= growth);
      growth = value - before;
      before = value;
    }
    CHECK(growth > 0);
  });
}

TEST_CASE("adhesions attract, with the peak traction and work of the law", "[laws]") {
  for_each_law<AdhesionLaw, NormalAdhesion>([](const NormalAdhesion& law, const PairMaterials& pair) {
    constexpr int n = 20000;
    double peak = 0, work = 0, peak_gap = 0;
    for (int i = 0; i < n; ++i) {
      const double d = law.range() * (i + 0.5) / n;
      const double traction = law.at(d).slope;
      REQUIRE(traction >= 0);
      work += traction * law.range() / n;
      if (traction >= peak) peak_gap = d;  // the last, of a plateau
      peak = std::max(peak, traction);
    }
    CHECK(law.peak_traction() == Approx(peak).epsilon(1e-4));
    CHECK(law.work_of_adhesion() == Approx(work).epsilon(1e-4));
    const LawSample start = law.at(1e-9 * law.range());
    CHECK(law.work_of_adhesion() == Approx(1e-9 * law.range() * start.slope - start.value).epsilon(1e-12));
    CHECK(peak_gap >= pair.contact_distance * (1 - 1e-3));  // where the barrier does not push
  });
}
