// Parallel loops, sums and merges against serial ones, for any number of threads.
#include "geometry/parallel.hpp"

#include <catch2/catch.hpp>
#include <tbb/global_control.h>

#include <numeric>
#include <random>

#include "geometry/merge_sorted.hpp"
#include "geometry/parallel_loops.hpp"
#include "geometry/prefix_sums.hpp"

using namespace tack;

TEST_CASE("loops that run together visit each chunk of each loop once", "[parallel]") {
  const int threads = GENERATE(1, 2, 4);
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
  const std::vector<int> lengths = {0, 1, 1000, 0, 64, 65, 7};
  std::vector<std::vector<int>> visits;
  for (const int n : lengths) visits.emplace_back(n, 0);
  ParallelLoops loops;
  for (size_t l = 0; l < lengths.size(); ++l)
    loops.add(lengths[l], [&visited = visits[l], n = lengths[l]](int c, int first, int last) {
      if (first != 64 * c || last != std::min(n, first + 64)) return;
      for (int i = first; i < last; ++i) ++visited[i];
    }, 64);
  loops.run();
  for (size_t l = 0; l < lengths.size(); ++l) CHECK(visits[l] == std::vector<int>(lengths[l], 1));
  ParallelLoops().run();
}

TEST_CASE("prefix sums are those of a serial loop", "[parallel]") {
  std::mt19937 random(1);
  for (const int n : {0, 1, 2, 4095, 4096, 4097, 20000}) {
    std::vector<int> values(n), expected(n);
    for (int& value : values) value = std::uniform_int_distribution<int>(0, 9)(random);
    std::partial_sum(values.begin(), values.end(), expected.begin());
    prefix_sums(values);
    CHECK(values == expected);
  }
}

TEST_CASE("merged lists are those of a serial merge", "[parallel]") {
  std::mt19937 random(2);
  for (const int n : {0, 1, 1023, 1024, 5000})
    for (const int m : {0, 1, 3000}) {
      // Numbers of both lists alternate at random.
      std::vector<int> all(n + m), a, b;
      std::iota(all.begin(), all.end(), 0);
      std::vector<char> in_a(n + m, 0);
      std::fill(in_a.begin(), in_a.begin() + n, 1);
      std::shuffle(in_a.begin(), in_a.end(), random);
      for (const int i : all) (in_a[i] ? a : b).push_back(i);
      CHECK(merge_sorted(a, b, [](int i) { return i; }) == all);
    }
}
