// The forces that a change of covered areas exerts: minus the gradient of sum_T int_{T covered} phi(d) dA through the
// areas alone, at the start of the step, where phi < 0 (what presses has no lateral force). It has two parts:
//   rim      A piece of length l of an edge of b, at r, over a point p inside a triangle of a: moving apart by s along
//            the outward in-plane normal m = e x n of the edge uncovers l s,
//                s = m . (p - r),   f = phi l grad s.
//            m turns with b's triangle: by -(n . u_j) grad lambda_j for a displacement u_j of its corner j, and so
//                ds/dp = m,   ds/du_j = -beta_j m + (n . (p - r)) (m . grad lambda_j) n.
//   stretch  A covered triangle (a, b, c) has the area w = |n . N|/2 towards its leader, N = (b - a) x (c - a):
//                dw/da = s/2 (b - c) x n (cyclic),   dw/du_j = -s/2 (N . grad lambda_j) n,   s = sign(n . N).
// Both s and w do not change in rigid motions of the two triangles together, so that each part has neither a net force
// nor a moment.
#pragma once

#include <array>
#include <vector>

#include "framework/contact/covered_parts.hpp"
#include "framework/contact/held_surface.hpp"
#include "framework/contact/pair_table.hpp"

namespace tack {

class RimForces {
 public:
  // At the start of a step; held: there.
  void take(const std::vector<CoveredParts>& pairs, const PairTable& table, const CollisionMesh& mesh, const HeldSurface& held);
  // Of all pairs (3n) [N]; empty: none.
  const VecX& all() const { return all_; }
  // Of a pair, in either order (3n) [N].
  VecX between(int a, int b, Eigen::Index size) const;
  // That the second object exerts on the first [N].
  Vec3 on(int a, int b, const CollisionMesh& mesh) const;

 private:
  struct Pair {
    int a, b;
    std::vector<int> vertices;
    std::vector<Vec3> forces;  // N
  };
  std::vector<Pair> pairs_;
  VecX all_;
};

}  // namespace tack
