// Trace of a parallel loop that one thread runs, and its schedule on several cores.
#pragma once

#include <cstddef>
#include <vector>

#include "geometry/chunk_order.hpp"

namespace tack {

// Returns the time at which `cores` cores have worked off the chunks [s]: each core that is idle
// takes the next chunk, or the next strip of chunks that depend on others and waits for these.
// chunks: their times [s], in order. order: null, if they do not depend on each other.
double scheduled(const std::vector<double>& chunks, int cores, const ChunkOrder* order = nullptr);

// Lowers the longest times to one length such that their sum is `total` [s], if it exceeds it. Used
// for times on the wall, during which the thread was interrupted.
void lower_longest(std::vector<double>& seconds, double total);

// Times of the chunks of a loop. A chunk that runs other loops is divided into segments: before,
// between and after these loops.
class LoopTrace {
 public:
  void clear();
  // Ends a segment, which took `time` [s].
  void add_segment(double time) { marks_.push_back(Mark::segment), seconds_.push_back(time); }
  void end_chunk() { marks_.push_back(Mark::end_chunk); }
  // Begins and ends a loop inside a chunk.
  void begin_loop() { marks_.push_back(Mark::begin_loop), nested_ = true; }
  void end_loop() { marks_.push_back(Mark::end_loop); }

  bool nested() const { return nested_; }
  double seconds() const;
  size_t segments() const { return seconds_.size(); }
  // See above.
  void lower_longest(double total) { tack::lower_longest(seconds_, total); }
  // Returns the time at which `cores` cores have worked off the loop [s]. Chunks of loops inside
  // others are taken first, the latest loop before earlier ones, and a chunk goes on when all
  // chunks of its loop have ended. order: see above; chunks of a loop with an order have one
  // segment.
  double scheduled(int cores, const ChunkOrder* order = nullptr) const;

 private:
  enum class Mark : char { segment, end_chunk, begin_loop, end_loop };

  std::vector<double> seconds_;  // of the segments
  std::vector<Mark> marks_;      // in the order of the thread
  bool nested_ = false;
};

}  // namespace tack
