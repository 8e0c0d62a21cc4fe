// Largest traction of traction-separation laws.
#include "framework/contact/laws/law_peak.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/support/component_variants.hpp"

using namespace tack;

namespace {

LawPeak peak_of(const std::string& yaml, double* last = nullptr) {
  const auto law = component<AdhesionLaw>(yaml);
  law->prepare({.contact_distance = 1e-3});
  const auto& gap = dynamic_cast<const NormalLaw&>(*law);
  const LawPeak peak = largest_traction(gap);
  if (last) *last = last_gap_with(gap, 0.5 * peak.traction);
  return peak;
}

}  // namespace

TEST_CASE("peaks of traction-separation laws are found, at kinks and between grid points", "[law_peak]") {
  double last = 0;
  const LawPeak fang = peak_of("{type: fang, peak_traction: 2e4, peak_distance: 1.2345 mm, range: 5 mm}", &last);
  CHECK(fang.gap == Approx(1.2345e-3).epsilon(1e-6));
  CHECK(fang.traction == Approx(2e4).epsilon(1e-6));
  CHECK(last == Approx((1.2345e-3 + 5e-3) / 2).epsilon(1e-3));
  const LawPeak smooth = peak_of("{type: lennard_jones, work_of_adhesion: 1, range: 0.3 m}");  // its peak is 200 times closer than its range
  CHECK(smooth.gap == Approx(std::pow(3, 1.0 / 6) * 1e-3).epsilon(1e-4));
  CHECK(smooth.traction == Approx(16 / (9 * std::sqrt(3.0)) / 1e-3).epsilon(1e-6));
}

TEST_CASE("a law that only repels has no peak", "[law_peak]") {
  const auto barrier = component<BarrierLaw>("{type: clamped_log}");
  barrier->prepare({.contact_distance = 1e-3, .softer_young = 1e6});
  CHECK(largest_traction(*barrier).traction == 0);
  CHECK(largest_traction(*barrier).gap == 0);
}
