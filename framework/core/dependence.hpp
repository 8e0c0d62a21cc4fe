// Vertices whose place follows from that of others: x_v = sum_k w_k x_k, with weights that add up to one. Vertices of
// an affine body follow the four of its frame, those that are tied to an element its corners, and those of a finer
// contact surface the corners of the triangle that they lie in.
#pragma once

#include <utility>
#include <vector>

namespace tack {

struct Dependence {
  int vertex = -1;
  std::vector<std::pair<int, double>> on;  // vertices and weights
};

// At most one for each vertex; what a vertex depends on may depend on others in turn, but not on itself.
using Dependences = std::vector<Dependence>;

}  // namespace tack
