// Parallel loops that run at the same time. Short loops one after the other leave threads idle: the
// threads wait at the end of each for its last chunk.
#pragma once

#include <algorithm>
#include <functional>
#include <utility>
#include <vector>

#include "geometry/parallel.hpp"

namespace tack {

/// Loops over chunks (parallel.hpp) that run as one parallel loop.
class ParallelLoops {
 public:
  /// Adds a loop that calls body(chunk index, first, last) for each chunk of [0, n). Objects that
  /// the body refers to must outlive run().
  template <class Body>
  void add(int n, Body body, int chunk = chunk_size) {
    const int chunks = chunk_count(n, chunk);
    if (chunks == 0) return;
    loops_.push_back({chunks_, [n, chunk, body = std::move(body)](int c) {
                        detail::run_chunks(c, c + 1, n, chunk, body);
                      }});
    chunks_ += chunks;
  }

  /// Runs all loops. Chunks of different loops run in any order.
  void run(SourcePosition loop_start = SourcePosition::current()) const {
    for_each(
        chunks_,
        [&](int c) {
          const auto after = std::upper_bound(loops_.begin(), loops_.end(), c,
                                              [](int k, const Loop& l) { return k < l.first; });
          const Loop& loop = *(after - 1);
          loop.run_chunk(c - loop.first);
        },
        1, loop_start);
  }

 private:
  struct Loop {
    int first;                           // chunk of run()
    std::function<void(int)> run_chunk;  // of a chunk of the loop
  };
  std::vector<Loop> loops_;
  int chunks_ = 0;
};

}  // namespace tack
