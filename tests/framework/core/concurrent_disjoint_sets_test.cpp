// Sets joined by several threads at a time equal those joined by one thread.
#include "framework/core/concurrent_disjoint_sets.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <thread>

#include "framework/core/concurrent_maximum.hpp"
#include "framework/core/disjoint_sets.hpp"

using namespace tack;

TEST_CASE("sets that four threads join have the members that one thread gives them", "[core]") {
  constexpr int members = 20000, joins = 15000, threads = 4;
  std::mt19937 random(7);
  std::vector<std::pair<int, int>> pairs(joins);
  for (auto& [i, j] : pairs) i = static_cast<int>(random() % members), j = static_cast<int>(random() % members);
  DisjointSets serial(members);
  for (const auto& [i, j] : pairs) serial.join(i, j);
  ConcurrentDisjointSets sets;
  for (int repeat = 0; repeat < 10; ++repeat) {
    sets.reset(members);
    std::vector<std::thread> running;
    for (int t = 0; t < threads; ++t)
      running.emplace_back([&, t] {
        // Every pair is joined by two threads, in opposite orders.
        for (int k = t % 2; k < joins; k += 2) t < 2 ? sets.join(pairs[k].first, pairs[k].second) : sets.join(pairs[joins - 1 - k].second, pairs[joins - 1 - k].first);
      });
    for (std::thread& thread : running) thread.join();
    int others = 0;
    for (int i = 0; i < members; ++i) others += sets.find(i) != serial.find(i);
    CHECK(others == 0);
  }
}

TEST_CASE("threads find the largest value and ignore values that are not numbers", "[core]") {
  double largest = 0;
  std::vector<std::thread> running;
  for (int t = 0; t < 4; ++t)
    running.emplace_back([&, t] {
      for (int k = 0; k < 10000; ++k) raise(largest, k % 100 == 50 ? std::nan("") : 1.0 + (k * 4 + t) % 39989);
    });
  for (std::thread& thread : running) thread.join();
  double expected = 0;
  for (int t = 0; t < 4; ++t)
    for (int k = 0; k < 10000; ++k)
      if (k % 100 != 50) expected = std::max(expected, 1.0 + (k * 4 + t) % 39989);
  CHECK(largest == expected);
}
