// Dependencies between the chunks of a loop.
#pragma once

#include <vector>

namespace tack {

/// The chunks that each chunk depends on: earlier ones.
struct ChunkOrder {
  int chunks() const { return static_cast<int>(start.size()) - 1; }

  std::vector<int> start = {0};  // first entry of each chunk in `before`, and the end
  std::vector<int> before;       // chunks
  // First chunk of each strip, and the end: chunks that one thread takes one after the other.
  std::vector<int> strip_start;
};

}  // namespace tack
