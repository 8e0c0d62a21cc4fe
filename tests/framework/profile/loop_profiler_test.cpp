// Loops of a thread are observed, named and timed; what they compute does not change.
#include <catch2/catch.hpp>

#include <cmath>
#include <stdexcept>
#include <vector>

#include "framework/profile/loop_label.hpp"
#include "framework/profile/loop_profiler.hpp"
#include "geometry/parallel.hpp"

using namespace tack;

namespace {

double work(int first, int last) {
  double sum = 0;
  for (int i = first; i < last; ++i) sum += std::sin(i) * std::cos(1e-3 * i);
  return sum;
}

double serial_work() { return work(0, 200000); }

template <class Body>
void call(const Body& body) {
  for_each(1000, body);
}

const LoopCost& cost_named(const CoreScaling& scaling, const std::string& start, bool serial) {
  for (const LoopCost& cost : scaling.costs)
    if (cost.name.starts_with(start) && cost.serial == serial) return cost;
  throw std::runtime_error("no cost named " + start);
}

}  // namespace

TEST_CASE("labels of loops are short") {
  CHECK(function_label("double tack::SolidTerm<Law>::value(const tack::VecX&) const [with Law = tack::NeoHookean]") == "SolidTerm<NeoHookean>::value");
  CHECK(function_label("void tack::{anonymous}::order(std::vector<std::pair<int, int> >&)") == "order");
  CHECK(function_label("void tack::(anonymous namespace)::order(int)") == "order");
  CHECK(function_label("tack::Box::f(int)::<lambda(int)>") == "Box::f");
  CHECK(function_label("std::vector<int> tack::Bvh::pairs(const std::vector<double>&, int) const") == "Bvh::pairs");
  CHECK(function_label("void tack::Factor::for_each_part(const Body&) const [with Body = tack::Factor::apply(const VecX&)::<lambda(int)>; T = int]") ==
        "Factor::for_each_part of Factor::apply");
  CHECK(function_label("void tack::f(int) [with Body = tack::g<tack::Long<int, double>, tack::Longer<tack::LongestOfAllNames, double> >(int)::<lambda(int)>]") == "f of g<...>");
  CHECK(function_label("int main()") == "main");
}

TEST_CASE("the seconds of loops and serial code add up to the time of the thread") {
  PhaseClock clock;
  const double expected = sum_chunks(100000, work);
  double sum = 0, rest = 0;
  LoopProfiler profiler(clock, {12, 64});
  {
    const PhaseScope phase(clock, Phase::assembly);
    for (int k = 0; k < 20; ++k) sum = sum_chunks(100000, work);
  }
  {
    const PhaseScope phase(clock, Phase::io);
    for (int k = 0; k < 5; ++k) rest += serial_work();
  }
  const PhaseClock::Seconds wall = clock.seconds();
  const CoreScaling scaling = profiler.finish();
  CHECK(sum == expected);
  CHECK(rest != 0);
  CHECK(scaling.cores == std::vector<int>{2, 4, 12, 64});
  CHECK(scaling.asked == 12);
  const LoopCost& loop = cost_named(scaling, "", false);
  CHECK(loop.phase == Phase::assembly);
  CHECK(loop.name.find("loop_profiler_test.cpp:") != std::string::npos);
  CHECK(loop.runs == 20);
  CHECK(loop.chunks == 20 * 391);
  CHECK(loop.undivided == 0);
  // Processor seconds may be fewer than those on the wall, never more but for the clocks' errors.
  const auto of = [&](Phase phase) { return wall[static_cast<int>(phase)]; };
  CHECK(scaling.seconds(Phase::assembly) < 1.05 * of(Phase::assembly));
  CHECK(scaling.seconds(Phase::io) < 1.05 * of(Phase::io));
  CHECK(scaling.serial_seconds(Phase::io) == scaling.seconds(Phase::io));
  CHECK(scaling.seconds() > 0);
  CHECK(scaling.serial_seconds(Phase::assembly) < 0.2 * scaling.seconds(Phase::assembly));
  CHECK(scaling.speed_up(0) > 1);
  CHECK(scaling.speed_up(0) <= Approx(2));
  CHECK(loop.on_cores[0] >= Approx(loop.seconds / 2));
  CHECK(loop.on_cores[3] >= Approx(loop.seconds / 64));
  CHECK(scaling.speed_up_of_loops(0) > 1.5);
  CHECK(cost_named(scaling, "", true).seconds > 0);
}

TEST_CASE("loops inside chunks belong to the outermost one, and those of other scopes are not timed") {
  PhaseClock clock;
  LoopProfiler profiler(clock, {2});
  std::vector<double> out(4);
  for_each(4, [&](int i) { out[i] = sum_chunks(1000, work); }, 1);
  {
    const LoopProfiler::Pause pause(&profiler);
    for_each(1000, [](int) {});
  }
  call([](int) {});
  for_each(0, [](int) {});
  for_each(1, [](int) {});
  const CoreScaling scaling = profiler.finish();
  for_each(1000, [](int) {});
  long runs = 0, undivided = 0;
  for (const LoopCost& cost : scaling.costs)
    if (!cost.serial) runs += cost.runs, undivided += cost.runs - cost.divided_runs;
  CHECK(runs == 3);
  CHECK(undivided == 1);
  CHECK(out == std::vector<double>(4, sum_chunks(1000, work)));
  CHECK(scaling.cores == std::vector<int>{2, 4});
}

TEST_CASE("a single chunk with a loop inside is divided") {
  PhaseClock clock;
  LoopProfiler profiler(clock, {64});
  double sum = 0;
  for_each(1, [&](int) { sum = sum_chunks(100000, work); });
  const CoreScaling scaling = profiler.finish();
  CHECK(sum == sum_chunks(100000, work));
  const LoopCost& loop = cost_named(scaling, "", false);
  CHECK(loop.runs == 1);
  CHECK(loop.chunks == 1);
  CHECK(loop.divided_runs == 1);
  CHECK(loop.undivided == 0);
  CHECK(loop.on_cores[0] < 0.75 * loop.seconds);  // 2 cores
}

TEST_CASE("an error in a loop passes through its observer") {
  PhaseClock clock;
  LoopProfiler profiler(clock, {2});
  CHECK_THROWS_AS(for_each(1000, [](int i) { if (i == 700) throw std::runtime_error("no"); }), std::runtime_error);
  for_each(1000, [](int) {});
  long runs = 0;
  for (const LoopCost& cost : profiler.finish().costs) runs += cost.serial ? 0 : cost.runs;
  CHECK(runs == 1);
}
