#include "framework/sensitivity/history_jumps.hpp"

#include <catch2/catch.hpp>

using namespace tack;

TEST_CASE("nearly equal history entries are kept", "[sensitivity]") {
  const History run = {{"a", {2, {1.5, 2.25, -3.5, 1e-9}, {}}}};
  History other = {{"a", {2, {1.5 * (1 + 1e-6), 2.25, -3.5, 2e-9}, {}}}};
  const History before = other;
  CHECK(replace_jumps(run, other) == 0);
  CHECK(other == before);
}

TEST_CASE("noise is not a jump", "[sensitivity]") {
  // An entry like a plastic deformation gradient, with a component that is zero up to rounding.
  const History run = {{"tensors", {3, {1.01, 0, 0.99, 1.02, 1e-19, 0.98}, {}}}};
  History other = {{"tensors", {3, {1.0100001, 2e-18, 0.99, 1.02, -3e-19, 0.98}, {}}}};
  CHECK(replace_jumps(run, other) == 0);
}

TEST_CASE("jumping entries are taken from the run one by one", "[sensitivity]") {
  const History run = {{"places", {2, {7, 0.5, 12, 0.25}, {{3, 1}, {4, 1}}}}};
  SECTION("another triangle") {
    History other = {{"places", {2, {7, 0.5000001, 13, 0.25}, {{3, 1}, {4, 1}}}}};
    CHECK(replace_jumps(run, other) == 1);
    CHECK(other.at("places").values == std::vector<double>{7, 0.5000001, 12, 0.25});
  }
  SECTION("an entry that only the run has") {
    History other = {{"places", {2, {12, 0.2500001}, {{4, 1}}}}};
    CHECK(replace_jumps(run, other) == 1);
    CHECK(other.at("places").keys == run.at("places").keys);
    CHECK(other.at("places").values == std::vector<double>{7, 0.5, 12, 0.2500001});
  }
  SECTION("an entry and an array that the run lacks") {
    History other = {{"places", {2, {7, 0.5000001, 12, 0.25, 1, 1}, {{3, 1}, {4, 1}, {5, 1}}}}, {"more", {1, {1}, {}}}};
    CHECK(replace_jumps(run, other) == 2);
    CHECK(other.size() == 1);
    CHECK(other.at("places").values == std::vector<double>{7, 0.5000001, 12, 0.25});
  }
  SECTION("different numbers of entries with one key") {
    const History pairs = {{"places", {1, {0.5, 0.75, 0.25}, {{3, 1}, {3, 1}, {4, 1}}}}};
    History other = {{"places", {1, {0.5, 0.2500001}, {{3, 1}, {4, 1}}}}};
    CHECK(replace_jumps(pairs, other) == 2);
    CHECK(other.at("places").values == std::vector<double>{0.5, 0.75, 0.2500001});
  }
  SECTION("no entries") {
    History other;
    CHECK(replace_jumps(run, other) == 2);
    CHECK(other == run);
  }
}
