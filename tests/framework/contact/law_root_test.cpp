// The signed root of a law's energy: its product with its slope is the slope of the law, and it
// rises through the gap of lowest energy.
#include "framework/contact/laws/law_root.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/support/component_variants.hpp"

using namespace tack;

namespace {

PairLaw law_of(bool adhesive, double offset) {
  PairLaw law(offset);
  const auto add = [&](auto component) {
    std::shared_ptr<NormalLaw> shared = dynamic_cast<const NormalLaw&>(*component).clone();
    shared->prepare({1e-3, 1e5, 0});
    law.add(shared);
  };
  add(component<BarrierLaw>("{type: clamped_log, stiffness: 3e3}"));
  if (adhesive) add(component<AdhesionLaw>("{type: fang, young: 1e4, critical_strain: 0.2}"));
  return law;
}

}  // namespace

TEST_CASE("the root of a law times its slope is the slope of the law, and half its square the energy above the lowest", "[contact][root]") {
  for (const bool adhesive : {false, true})
    for (const double offset : {0.0, 2e-3}) {
      const PairLaw law = law_of(adhesive, offset);
      const LawRoot root(law);
      CHECK(root.depth() == Approx(adhesive ? law.well().depth : 0).margin(1e-12));
      const double top = law.range() - offset;
      for (double gap = 0.02 * top; gap < 0.999 * top; gap += 0.01 * top) {
        const LawSample phi = law.at(offset + gap);
        const LawRoot::Sample rho = root.at(offset + gap, phi);
        CHECK(rho.value * rho.slope == Approx(phi.slope).margin(1e-9));
        CHECK(rho.value * rho.value / 2 == Approx(phi.value + root.depth()).margin(1e-9));
      }
    }
}

TEST_CASE("the root of an adhesive law rises through the gap of lowest energy", "[contact][root]") {
  const PairLaw law = law_of(true, 0);
  const LawRoot root(law);
  const double bottom = law.well().gap;
  double before = -1e9;
  for (double gap = 0.5 * bottom; gap < 1.5 * bottom; gap += 0.01 * bottom) {
    const LawRoot::Sample rho = root.at(gap, law.at(gap));
    CHECK(rho.value > before);
    if (std::abs(gap - bottom) > 1e-3 * bottom) CHECK((rho.value > 0) == (gap > bottom));
    CHECK(rho.slope > 0);
    before = rho.value;
  }
}

TEST_CASE("the root of a law that only repels is negative within its range and zero beyond", "[contact][root]") {
  const PairLaw law = law_of(false, 0);
  const LawRoot root(law);
  for (const double part : {0.1, 0.5, 0.9}) CHECK(root.at(part * law.range(), law.at(part * law.range())).value < 0);
  for (const double part : {1.0, 1.1, 5.0}) CHECK(root.at(part * law.range(), law.at(part * law.range())).value == 0);
}
