// Multi-point constraints: the position of a dependent vertex v is
//     x_v = sum_k w_k x_k,   sum_k w_k = 1.
//   dependent vertex            depends on
//   of an affine body           the four vertices of its frame
//   attached to an element      the corners of the element
//   of a finer contact surface  the corners of the triangle that contains it
#pragma once

#include <utility>
#include <vector>

namespace tack {

/// One dependent vertex.
struct Dependence {
  int vertex = -1;
  std::vector<std::pair<int, double>> on;  // vertices and weights
};

/// At most one constraint per vertex. Chains are allowed, cycles are not.
using Dependences = std::vector<Dependence>;

}  // namespace tack
