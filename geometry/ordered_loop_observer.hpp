// Observer that knows the dependencies between the chunks of a loop (ordered_loop.hpp).
#pragma once

#include "geometry/chunk_order.hpp"
#include "geometry/loop_observer.hpp"

namespace tack {

/// An observer of loops with and without dependencies.
class OrderedLoopObserver : public LoopObserver {
 public:
  using LoopObserver::run;
  /// Calls chunk(0), ..., chunk(chunks - 1) in this order and thread. order: their dependencies.
  virtual void run(const SourcePosition& loop, int chunks, const ChunkCall& chunk,
                   const ChunkOrder& order) = 0;
};

}  // namespace tack
