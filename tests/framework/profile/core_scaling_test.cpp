// Predicted speed-ups against closed forms.
#include <catch2/catch.hpp>

#include <numeric>

#include "framework/profile/profile.hpp"

using namespace tack;
using Catch::Contains;

namespace {

LoopCost loop_of(const std::string& name, const std::vector<double>& pieces, const std::vector<int>& cores) {
  LoopCost cost;
  cost.name = name;
  cost.runs = cost.divided_runs = 1;
  cost.pieces = static_cast<long>(pieces.size());
  cost.seconds = std::accumulate(pieces.begin(), pieces.end(), 0.0);
  for (const int p : cores) cost.on_cores.push_back(scheduled(pieces, p));
  return cost;
}

LoopCost serial_of(const std::string& name, double seconds, const std::vector<int>& cores) {
  LoopCost cost;
  cost.name = name;
  cost.serial = true;
  cost.runs = 1;
  cost.seconds = cost.undivided = seconds;
  cost.on_cores.assign(cores.size(), seconds);
  return cost;
}

}  // namespace

TEST_CASE("equal pieces take as many rounds as they need") {
  const std::vector<double> pieces(10, 0.5);
  for (const int cores : {1, 2, 3, 4, 9, 10, 11, 64}) {
    CAPTURE(cores);
    CHECK(scheduled(pieces, cores) == Approx(0.5 * ((10 + cores - 1) / cores)));
  }
  CHECK(scheduled({}, 4) == 0);
}

TEST_CASE("a large piece bounds the time, wherever it stands") {
  std::vector<double> pieces(12, 1.0);
  pieces.front() = 20;
  for (const int cores : {2, 4, 12}) CHECK(scheduled(pieces, cores) == Approx(20));
  std::swap(pieces.front(), pieces.back());
  CHECK(scheduled(pieces, 2) == Approx(25));  // eleven of the others before it: the sixth ends at 5 on one core
  CHECK(scheduled(pieces, 64) == Approx(20));
}

TEST_CASE("cores take pieces in order as they get idle") {
  CHECK(scheduled({3, 1, 1, 1, 2}, 2) == Approx(5));
  CHECK(scheduled({1, 2, 3}, 1) == Approx(6));
}

TEST_CASE("interrupted pieces are lowered to the processor time") {
  std::vector<double> pieces = {1, 5, 2, 9};
  lower_longest(pieces, 9);
  CHECK(pieces == std::vector<double>{1, 3, 2, 3});
  lower_longest(pieces, 20);
  CHECK(pieces == std::vector<double>{1, 3, 2, 3});
  lower_longest(pieces, 2);
  CHECK(pieces == std::vector<double>(4, 0.5));
  lower_longest(pieces, -1);
  CHECK(pieces == std::vector<double>(4, 0.0));
}

TEST_CASE("serial code bounds the speed-up by Amdahl's law") {
  const std::vector<int> cores = {2, 4, 12, 64};
  const CoreScaling scaling{cores, 12, {serial_of("pattern", 2, cores), loop_of("solids", std::vector<double>(7680, 1e-3), cores)}};
  const double serial = 2 / 9.68;
  for (size_t k = 0; k < cores.size(); ++k) {
    CAPTURE(cores[k]);
    CHECK(scaling.speed_up(k) == Approx(1 / (serial + (1 - serial) / cores[k])));
    CHECK(scaling.speed_up_of_loops(k) == Approx(cores[k]));
  }
  CHECK(scaling.seconds() == Approx(9.68));
  CHECK(scaling.serial_seconds() == Approx(2));
  CHECK(scaling.share_lost(scaling.costs[0]) == Approx(1));
  CHECK(scaling.share_lost(scaling.costs[1]) == Approx(0).margin(1e-12));
}

TEST_CASE("losses are those of the cores asked for, the largest first") {
  const std::vector<int> cores = {2, 12};
  CoreScaling scaling{cores, 12, {}};
  scaling.costs = {serial_of("short", 1, cores), loop_of("two pieces", {2, 2}, cores), loop_of("many", std::vector<double>(240, 0.1), cores)};
  scaling.sort();
  CHECK(scaling.costs[0].name == "two pieces");  // loses 2 - 4 / 12 s
  CHECK(scaling.costs[1].name == "short");       // loses 1 - 1 / 12 s
  CHECK(scaling.costs[2].name == "many");
  CHECK(scaling.share_lost(scaling.costs[0]) == Approx((2 - 4. / 12) / (2 - 4. / 12 + 1 - 1. / 12)));
  CHECK(scaling.divided_runs() == 2);
}

TEST_CASE("runs of one piece count as serial") {
  const std::vector<int> cores = {2};
  LoopCost cost = loop_of("small", {3}, cores);
  cost.undivided = 3;
  const CoreScaling scaling{cores, 2, {cost, loop_of("other", {1, 1}, cores)}};
  CHECK(scaling.serial_seconds() == Approx(3));
  CHECK(scaling.speed_up(0) == Approx(5. / 4));
  CHECK(scaling.speed_up_of_loops(0) == Approx(2));
}

TEST_CASE("a remark says which serial code or loop leaves cores idle") {
  Profile p;
  p.steps = p.iterations = 1;
  p.phases[static_cast<int>(Phase::assembly)] = 10;
  const std::vector<int> cores = {2, 4, 12};
  p.scaling = {cores, 12, {serial_of("LocalSums::build, local_sums.cpp:40 to 55", 2, cores), loop_of("solids", std::vector<double>(800, 0.01), cores)}};
  REQUIRE(remarks_on(p).size() == 1);
  CHECK_THAT(remarks_on(p)[0], Contains("12 cores would run the steps at most 3.7 times as fast") && Contains("20% of their time is serial") &&
                                   Contains("100% of the loss is serial code from LocalSums::build"));
  CHECK_THAT(scaling_tables(p.scaling), Contains("what holds 12 cores back") && Contains("LocalSums::build"));
  p.scaling.costs[0] = serial_of("short", 0.3, cores);
  CHECK(remarks_on(p).empty());
  CHECK(scaling_tables({}).empty());
}
