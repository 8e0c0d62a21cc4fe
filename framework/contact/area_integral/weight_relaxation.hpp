// Aitken relaxation of the lagged weights of rods and particles (codimensional_weights.hpp) between
// steps.
//
// Lagged weights are constant in a step, so that their change exerts no force. If the modulus of a
// body is no larger than the traction on it, a vertex overshoots, has another weight there, comes
// back too far, and oscillates in every other step. With r, the difference between the weights and
// normals of a point towards an object and the lagged values of the last step, a step therefore
// changes the lagged values by t r only,
//     t = t' r'.(r' - r) / |r' - r|^2,  in [0.01, 1],
// where ' marks the last step. If r is linear in the lagged values, this finds their fixed point.
// While r keeps its direction, t = 1. t grows by at most a factor of 1.2 from step to step.
// Source: Irons and Tuck 1969, A version of the Aitken accelerator for computer iteration; Kuettler
// and Wall 2008, Fixed-point fluid-structure interaction solvers with dynamic relaxation.
#pragma once

#include <span>
#include <vector>

#include "framework/contact/area_integral/codimensional_weights.hpp"
#include "framework/core/history.hpp"
#include "geometry/mesh/collision_mesh.hpp"

namespace tack {

// Lagged values of a point and a triangle within the range of its law: the weight and the normal of
// the triangle.
struct LaggedWeight {
  using Values = std::array<double, 4>;
  int point, triangle;
  Values values, change;  // values of the step; r
  double factor;          // t
};

// Sorted by point, then triangle.
using LaggedWeights = std::vector<LaggedWeight>;

// Relaxes the weights and normals of a point towards triangles of one object, and appends the
// lagged values to `now`. Triangles beyond `range`, that of the law [m], are not relaxed.
void relax_weights(int point, std::span<const int> triangles, double range,
                   const LaggedWeights& before, std::vector<TriangleWeight>& weights,
                   LaggedWeights& now);

// Reads lagged weights from the history. Throws InputError for triangles that do not exist.
LaggedWeights weights_of(const History& history, const CollisionMesh& mesh);
// Stores lagged weights in the history; no array if there are none.
void store_weights(const LaggedWeights& weights, const CollisionMesh& mesh, History& history);

}  // namespace tack
