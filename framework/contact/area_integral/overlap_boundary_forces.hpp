// Overlap-boundary forces: minus the derivative of the adhesion energy sum_T int_{T overlap} phi(d)
// dA by vertex positions through the overlap area alone (a shape derivative, a configurational
// force), evaluated at the start of the step where phi < 0. Pressure has no lateral force. Two
// contributions:
//   boundary  A segment of length l of an edge e of b, at r, over a point p inside a triangle of a.
//             With n the normal of b's triangle, m = e x n is the outward in-plane normal of the
//             edge. Moving apart by s along m removes the area l s,
//                 s = m . (p - r),   f = phi l grad s.
//             m turns with b's triangle by -(n . u_j) grad lambda_j for a displacement u_j of
//             corner j:
//                 ds/dp = m,   ds/du_j = -beta_j m + (n . (p - r)) (m . grad lambda_j) n.
//   stretch   An overlapping triangle (a, b, c) has the projected area w = |n . N|/2 towards its
//             seed triangle of normal n, N = (b - a) x (c - a):
//                 dw/da = s/2 (b - c) x n (cyclic),   dw/du_j = -s/2 (N . grad lambda_j) n,
//                 s = sign(n . N).
// s and w are invariant in rigid motions of both triangles together, so that neither contribution
// has a net force or moment.
//
// Segments close to the boundary of a's own surface are overhangs instead, whose force depends on
// the positions (overhang.hpp).
#pragma once

#include <array>
#include <vector>

#include "framework/contact/area_integral/overhang.hpp"
#include "framework/contact/area_integral/overlap_facets.hpp"
#include "framework/contact/surface/lagged_surface.hpp"
#include "framework/contact/laws/pair_table.hpp"

namespace tack {

class OverlapBoundaryForces {
 public:
  // Sets the forces of a step. lagged: the surface at its start.
  void update(const std::vector<OverlapFacets>& pairs, const PairTable& table,
              const CollisionMesh& mesh, const LaggedSurface& lagged);
  // Returns the constant forces of all pairs (3n) [N]; empty: none.
  const VecX& all() const { return all_; }
  // Returns the overhangs of all pairs.
  const std::vector<Overhang>& overhangs() const { return overhangs_; }
  // Returns the constant forces of a pair, in either order (3n) [N].
  VecX between(int a, int b, Eigen::Index size) const;
  // Returns the constant force of object b on object a [N].
  Vec3 on(int a, int b, const CollisionMesh& mesh) const;

 private:
  struct Pair {
    int a, b;
    std::vector<int> vertices;
    std::vector<Vec3> forces;  // N
  };
  std::vector<Pair> pairs_;
  VecX all_;
  std::vector<Overhang> overhangs_;
};

}  // namespace tack
