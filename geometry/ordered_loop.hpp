// Parallel loops whose chunks depend on earlier ones, like the rows of a triangular solve. Threads
// take strips of consecutive chunks, which they read in the order of memory, and wait only for the
// chunks that the next one depends on (point-to-point synchronisation: Park, Smelyanskiy, Sundaram
// and Dubey 2014). The order of all sums is that of one thread: the same bits for any number of
// threads.
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>

#include <algorithm>
#include <atomic>
#include <memory>
#include <thread>
#include <utility>
#include <vector>

#include "geometry/chunk_order.hpp"
#include "geometry/loop_observer.hpp"
#include "geometry/thread_count.hpp"

namespace tack {

/// A loop over chunks with dependencies, and which chunks have ended.
class OrderedLoop {
 public:
  /// Sets the dependencies for the following runs.
  void reset(ChunkOrder order) {
    order_ = std::move(order);
    if (order_.chunks() <= capacity_) return;
    capacity_ = order_.chunks();
    ended_ = std::make_unique<Flag[]>(static_cast<size_t>(capacity_));
  }
  const ChunkOrder& order() const { return order_; }

  /// Calls body(chunk) for the first `chunks` chunks, each after those that it depends on. The
  /// body must not throw, and starts no other loop.
  template <class Body>
  void run(int chunks, const Body& body, SourcePosition loop = SourcePosition::current()) {
    if (loop_observer) [[unlikely]] {
      const auto one = [&](int c) { call(body, c, c + 1); };
      loop_observer->run(loop, chunks, ChunkCall(one), order_);
      return;
    }
    const int workers = std::min(thread_count(), chunks);
    if (workers <= 1) {
      call(body, 0, chunks);
      return;
    }
    ++run_;
    std::atomic<int> next = 0;
    const int strips = static_cast<int>(order_.strip_start.size()) - 1;
    const auto work = [&](const tbb::blocked_range<int>&) {
      for (int s = next++; s < strips && order_.strip_start[s] < chunks; s = next++)
        for (int c = order_.strip_start[s]; c < std::min(order_.strip_start[s + 1], chunks); ++c) {
          for (int k = order_.start[c]; k < order_.start[c + 1]; ++k) wait_for(order_.before[k]);
          call(body, c, c + 1);
          ended_[c].run.store(run_, std::memory_order_release);
        }
    };
    tbb::parallel_for(tbb::blocked_range<int>(0, workers, 1), work, tbb::simple_partitioner());
  }

 private:
  struct alignas(64) Flag {         // a cache line: threads write those of neighbours
    std::atomic<unsigned> run = 0;  // the last one in which the chunk has ended
  };

  // Not inlined: see detail::run_chunks.
  template <class Body>
  [[gnu::noinline]] static void call(const Body& body, int first, int last) {
    for (int c = first; c < last; ++c) body(c);
  }

  // Tells the core that this thread spins.
  static void pause() {
#if defined(__x86_64__)
    __builtin_ia32_pause();
#elif defined(__aarch64__)
    asm volatile("yield");
#endif
  }
  // Spins: a chunk takes microseconds, and the thread that has it does not wait for this one.
  void wait_for(int chunk) const {
    constexpr int spins_per_yield = 256;
    for (int spins = 1; ended_[chunk].run.load(std::memory_order_acquire) != run_; ++spins) {
      if (spins % spins_per_yield == 0) std::this_thread::yield();
      else pause();
    }
  }

  ChunkOrder order_;
  std::unique_ptr<Flag[]> ended_;
  int capacity_ = 0;  // flags
  unsigned run_ = 0;
};

}  // namespace tack
