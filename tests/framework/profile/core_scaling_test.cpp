// Predicted speed-ups against closed forms.
#include <catch2/catch.hpp>

#include <numeric>

#include "framework/profile/loop_trace.hpp"
#include "framework/profile/profile.hpp"

using namespace tack;
using Catch::Contains;

namespace {

LoopCost loop_of(const std::string& name, const std::vector<double>& chunks, const std::vector<int>& cores) {
  LoopCost cost;
  cost.name = name;
  cost.runs = cost.divided_runs = 1;
  cost.chunks = static_cast<long>(chunks.size());
  cost.seconds = std::accumulate(chunks.begin(), chunks.end(), 0.0);
  for (const int p : cores) cost.on_cores.push_back(scheduled(chunks, p));
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

TEST_CASE("equal chunks take as many rounds as they need") {
  const std::vector<double> chunks(10, 0.5);
  for (const int cores : {1, 2, 3, 4, 9, 10, 11, 64}) {
    CAPTURE(cores);
    CHECK(scheduled(chunks, cores) == Approx(0.5 * ((10 + cores - 1) / cores)));
  }
  CHECK(scheduled({}, 4) == 0);
}

TEST_CASE("a large chunk bounds the time, wherever it stands") {
  std::vector<double> chunks(12, 1.0);
  chunks.front() = 20;
  for (const int cores : {2, 4, 12}) CHECK(scheduled(chunks, cores) == Approx(20));
  std::swap(chunks.front(), chunks.back());
  CHECK(scheduled(chunks, 2) == Approx(25));  // eleven of the others before it: the sixth ends at 5 on one core
  CHECK(scheduled(chunks, 64) == Approx(20));
}

TEST_CASE("cores take chunks in order as they get idle") {
  CHECK(scheduled({3, 1, 1, 1, 2}, 2) == Approx(5));
  CHECK(scheduled({1, 2, 3}, 1) == Approx(6));
}

TEST_CASE("a chunk begins when those that it depends on have ended") {
  // Two strips: 0 1 2 one after the other, then 3 after 0 and 4 after 1 and 3.
  const ChunkOrder order{{0, 0, 1, 2, 3, 5}, {0, 1, 0, 1, 3}, {0, 3, 5}};
  const std::vector<double> seconds = {2, 5, 4, 1, 6};
  CHECK(scheduled(seconds, 1, &order) == Approx(18));
  CHECK(scheduled(seconds, 2, &order) == Approx(13));  // 3 waits until 2, 4 from 3 until 7
  CHECK(scheduled(seconds, 64, &order) == Approx(13));
  CHECK(scheduled({2, 5, 4, 1}, 64, &order) == Approx(11));  // the first chunks alone
}

TEST_CASE("interrupted chunks are lowered to the processor time") {
  std::vector<double> chunks = {1, 5, 2, 9};
  lower_longest(chunks, 9);
  CHECK(chunks == std::vector<double>{1, 3, 2, 3});
  lower_longest(chunks, 20);
  CHECK(chunks == std::vector<double>{1, 3, 2, 3});
  lower_longest(chunks, 2);
  CHECK(chunks == std::vector<double>(4, 0.5));
  lower_longest(chunks, -1);
  CHECK(chunks == std::vector<double>(4, 0.0));
}

TEST_CASE("loops inside chunks are divided too") {
  LoopTrace trace;
  CHECK(trace.scheduled(4) == 0);
  // One chunk: 1 s, a loop of four chunks of 2 s, 3 s.
  trace.add_segment(1);
  trace.begin_loop();
  for (int i = 0; i < 4; ++i) trace.add_segment(2), trace.end_chunk();
  trace.end_loop();
  trace.add_segment(3);
  trace.end_chunk();
  CHECK(trace.nested());
  CHECK(trace.seconds() == 12);
  CHECK(trace.segments() == 6);
  CHECK(trace.scheduled(1) == Approx(12));
  CHECK(trace.scheduled(2) == Approx(8));
  CHECK(trace.scheduled(3) == Approx(8));
  CHECK(trace.scheduled(4) == Approx(6));
  CHECK(trace.scheduled(64) == Approx(6));
  // A second chunk of 5 s: it fills the cores that the loop leaves idle.
  trace.add_segment(5);
  trace.end_chunk();
  CHECK(trace.scheduled(1) == Approx(17));
  CHECK(trace.scheduled(2) == Approx(10));  // 1 s beside the second chunk, which ends at 5; the loop at 7
  CHECK(trace.scheduled(5) == Approx(6));
  trace.clear();
  trace.add_segment(2), trace.end_chunk(), trace.add_segment(1), trace.end_chunk();
  CHECK_FALSE(trace.nested());
  CHECK(trace.scheduled(2) == Approx(2));
}

TEST_CASE("loops inside loops inside loops") {
  // Two chunks, each with a loop of two chunks, each with a loop of two chunks of 1 s.
  LoopTrace trace;
  for (int i = 0; i < 2; ++i) {
    trace.add_segment(0);
    trace.begin_loop();
    for (int k = 0; k < 2; ++k) {
      trace.add_segment(0);
      trace.begin_loop();
      for (int m = 0; m < 2; ++m) trace.add_segment(1), trace.end_chunk();
      trace.end_loop();
      trace.add_segment(0);
      trace.end_chunk();
    }
    trace.end_loop();
    trace.add_segment(0);
    trace.end_chunk();
  }
  for (const int cores : {1, 2, 4, 8}) CHECK(trace.scheduled(cores) == Approx(8.0 / cores));
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
  scaling.costs = {serial_of("short", 1, cores), loop_of("two chunks", {2, 2}, cores), loop_of("many", std::vector<double>(240, 0.1), cores)};
  scaling.sort();
  CHECK(scaling.costs[0].name == "two chunks");  // loses 2 - 4 / 12 s
  CHECK(scaling.costs[1].name == "short");       // loses 1 - 1 / 12 s
  CHECK(scaling.costs[2].name == "many");
  CHECK(scaling.share_lost(scaling.costs[0]) == Approx((2 - 4. / 12) / (2 - 4. / 12 + 1 - 1. / 12)));
  CHECK(scaling.divided_runs() == 2);
}

TEST_CASE("runs of one chunk count as serial") {
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
