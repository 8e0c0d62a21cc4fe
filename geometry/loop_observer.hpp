// Observer of the parallel loops that a thread starts. `tack profile --cores` uses one to time the
// chunks of each loop (framework/profile/loop_profiler.hpp). Without an observer a loop pays one
// branch.
#pragma once

#include <utility>

#include "geometry/source_position.hpp"

namespace tack {

struct ChunkOrder;

/// Reference to a callable of one chunk index.
class ChunkCall {
 public:
  template <class Call>
  explicit ChunkCall(const Call& call)
      : call_(&call),
        run_([](const void* c, int chunk) { (*static_cast<const Call*>(c))(chunk); }) {}
  void operator()(int chunk) const { run_(call_, chunk); }

 private:
  const void* call_;
  void (*run_)(const void*, int);
};

/// Runs the loops of the thread in which it is active.
class LoopObserver {
 public:
  virtual ~LoopObserver() = default;
  /// Calls chunk(0), ..., chunk(chunks - 1) in this order and thread. `loop`: the position in the
  /// source that starts the loop.
  virtual void run(const SourcePosition& loop, int chunks, const ChunkCall& chunk) = 0;
  /// The same for a loop with dependencies between its chunks (ordered_loop.hpp).
  virtual void run(const SourcePosition& loop, int chunks, const ChunkCall& chunk,
                   const ChunkOrder& /*order*/) {
    run(loop, chunks, chunk);
  }
};

/// Active observer of this thread; null: none.
extern constinit thread_local LoopObserver* loop_observer;

/// Replaces the observer of this thread for the lifetime of a scope.
class LoopObserverScope {
 public:
  explicit LoopObserverScope(LoopObserver* observer)
      : outer_(std::exchange(loop_observer, observer)) {}
  ~LoopObserverScope() { loop_observer = outer_; }
  LoopObserverScope(const LoopObserverScope&) = delete;
  LoopObserverScope& operator=(const LoopObserverScope&) = delete;

 private:
  LoopObserver* outer_;
};

}  // namespace tack
