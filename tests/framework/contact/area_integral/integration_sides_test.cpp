#include "framework/contact/area_integral/integration_sides.hpp"

#include <catch2/catch.hpp>

using namespace tack;

namespace {

// Two objects; the surface of the first is finer.
PairTable pair_by_overlap() {
  PairTable pairs(ObjectClasses::single(2), {1e-6, 2e-6});
  pairs.point(0, 1) = pairs.point(1, 0) = {0, 1, 1e-3, true};
  return pairs;
}

bool first_chosen(const PairTable& pairs, IntegrationSides::Overlap first, IntegrationSides::Overlap second,
                  std::optional<IntegrationSides::Pairs> previous = std::nullopt) {
  IntegrationRules rules(pairs.classes());
  for (const auto& [a, b] : {std::pair(0, 1), {1, 0}}) rules.of(a, b).carries_pressure = rules.of(a, b).by_overlap = true;
  IntegrationSides sides(pairs, rules);
  sides.set_previous(std::move(previous));
  sides.overlap(0, 1) = first;
  sides.overlap(1, 0) = second;
  sides.choose();
  CHECK(sides.integrates(0, 1) != sides.integrates(1, 0));
  return sides.integrates(0, 1);
}

}  // namespace

TEST_CASE("integration sides: the side with the larger overlap, or the finer one if both are about equal", "[contact]") {
  const PairTable pairs = pair_by_overlap();
  CHECK(first_chosen(pairs, {}, {}));
  CHECK(first_chosen(pairs, {1, 2}, {0.8, 200}));
  CHECK_FALSE(first_chosen(pairs, {0.8, 200}, {1, 2}));
  CHECK_FALSE(first_chosen(pairs, {1, 2}, {0.95, 200}));
  CHECK(first_chosen(pairs, {0.95, 200}, {1, 2}));
  CHECK(first_chosen(pairs, {1, 8}, {1, 8}));
}

TEST_CASE("pins the overlap, seven tenths of the other side's, down to which a secondary side is kept", "[contact]") {
  const PairTable pairs = pair_by_overlap();
  const IntegrationSides::Pairs second = {{0, 1}};
  CHECK_FALSE(first_chosen(pairs, {1, 8}, {0.75, 8}, second));
  CHECK(first_chosen(pairs, {1, 8}, {0.65, 8}, second));
  CHECK_FALSE(first_chosen(pairs, {}, {}, second));
  CHECK(first_chosen(pairs, {1, 8}, {0.75, 8}, IntegrationSides::Pairs{}));
}
