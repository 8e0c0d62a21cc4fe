// Chunks run after those that they depend on, whatever the number of threads.
#include <catch2/catch.hpp>
#include <tbb/global_control.h>

#include <cstdint>

#include "geometry/ordered_loop.hpp"

using namespace tack;

namespace {

// Chunk (i, j) of a square waits for (i - 1, j) and (i, j - 1); strips are rows.
ChunkOrder square(int n) {
  ChunkOrder order;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      if (i > 0) order.before.push_back((i - 1) * n + j);
      if (j > 0) order.before.push_back(i * n + j - 1);
      order.start.push_back(static_cast<int>(order.before.size()));
    }
  for (int i = 0; i <= n; ++i) order.strip_start.push_back(i * n);
  return order;
}

// Returns a number for each chunk that depends on all chunks before it.
std::vector<std::uint64_t> hashes(OrderedLoop& loop, int chunks) {
  std::vector<std::uint64_t> hash(chunks, 0);
  const ChunkOrder& order = loop.order();
  loop.run(chunks, [&](int c) {
    std::uint64_t sum = static_cast<std::uint64_t>(c) + 1;
    for (int k = order.start[c]; k < order.start[c + 1]; ++k) sum = 6364136223846793005u * sum + hash[order.before[k]];
    hash[c] = sum;
  });
  return hash;
}

}  // namespace

TEST_CASE("chunks run after those that they depend on, with any number of threads") {
  OrderedLoop loop;
  for (const int n : {3, 30, 7}) {
    loop.reset(square(n));
    for (const int chunks : {n * n, n * n / 2, 1, 0}) {
      CAPTURE(n, chunks);
      const auto with_threads = [&](size_t threads) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        return hashes(loop, chunks);
      };
      const std::vector<std::uint64_t> expected = with_threads(1);
      for (int run = 0; run < 50; ++run)
        for (const size_t threads : {2, 4})
          if (with_threads(threads) != expected) FAIL(threads << " threads, run " << run);
    }
  }
}

TEST_CASE("an observer of loops without dependencies sees the chunks in their order") {
  struct : LoopObserver {
    void run(const SourcePosition&, int chunks, const ChunkCall& chunk) override {
      for (int c = 0; c < chunks; ++c) chunk(c);
    }
  } observer;
  OrderedLoop loop;
  loop.reset(square(5));
  std::vector<int> chunks;
  const LoopObserverScope scope(&observer);
  loop.run(25, [&](int c) { chunks.push_back(c); });
  REQUIRE(chunks.size() == 25);
  for (int c = 0; c < 25; ++c) CHECK(chunks[c] == c);
}
