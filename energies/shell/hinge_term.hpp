// Bending of a sheet: sum over triangles of 1/2 a^T C a, a = the angles of its three hinges less those at rest
// (hinge_fit.hpp). A stencil is a triangle and the vertices across its edges; at borders, the first vertex stands in for
// them and nothing acts on it. Triangles are computed pack_width at a time, one per lane.
//
// The angle of a hinge is that between the normals n1, n2 of its sides, positive where both apexes rise. For each side let
// m point from the edge e to the apex, h be the height, and A = sum_k (m . grad N_k) x_k, B = sum_k (e . grad N_k) x_k, N_k the
// side's barycentric coordinates. Then, with dx the change of the vertices,
//     d angle = sum over sides of A(dx) . n,
//     d2 angle = -sum over sides of 2 (A.m) (A.n) + (B.n) (2 (A.e) + B.m).
// The forms in each product have orthogonal coefficients, so that p r = ((k p + r/k)^2 - (k p - r/k)^2) / 4 separates its positive
// and negative part, k^2 the ratio of their lengths. A projected Hessian is the sum of C's part, which is definite, and those parts
// of the moments.
//
// An angle may pass pi: it is that which is nearest to the one at the start of the step, and turns beyond (-pi, pi] are
// remembered.
#pragma once

#include "energies/shell/hinge_fit.hpp"
#include "framework/core/term.hpp"
#include "framework/scene/body.hpp"
#include "geometry/pack.hpp"

namespace tack {

class HingeTerm : public Term, public StencilRanges {
 public:
  // stiffness: D [N m]. `rest_angles`: of the sheet as it is at rest; else it wants to be flat.
  HingeTerm(std::string name, const Body& body, const VecX& rest, double stiffness, double poisson, bool rest_angles);

  void remember(const History& history) override;
  void begin_step(const StepStart& start) override;
  void commit(const VecX& x, History& history) const override;

  double value(const VecX& x) const override;
  std::vector<StencilBatch> batches() const override { return {{6, count_, stencils_.front().data()}}; }
  void derivatives(const VecX& x, Projection projection, double* gradient, double* hessian) const override;
  const StencilRanges* ranges() const override { return this; }
  void range_derivatives(const VecX& x, Projection projection, int first, int last, double* gradient,
                         double* hessian) const override;

 private:
  struct Side {
    PackVec3 m, n;
    std::array<Pack, 3> alpha;  // m . grad N of the edge's first and second vertex and the apex
  };
  struct Hinge {
    PackVec3 e;
    Pack inverse_length;
    std::array<Side, 2> sides;  // of the triangle, and across
    Pack angle;                 // in (-pi, pi]; 0 at borders
  };
  using Corners = std::array<PackVec3, 6>;

  Corners corners(int first, int n, const VecX& x) const;
  std::array<Hinge, 3> hinges(int pack, const Corners& x) const;
  // The angles, nearest to those at the start of the step.
  PackVec3 unwound(int pack, const std::array<Hinge, 3>& hinges) const;
  void elements(int first, int n, const VecX& x, Projection projection, double* gradient, double* hessian) const;
  void add_moment(const Hinge& hinge, int i, const Pack& moment, Projection projection, Pack* slots) const;
  std::vector<double> turns(const VecX& x) const;  // of each hinge of each triangle, whole turns

  std::string memory_;  // its array in the history
  int count_ = 0;
  std::vector<std::array<int, 6>> stencils_;
  std::vector<int> repeated_;      // stencils in which a vertex is across two edges
  std::vector<PackMat3> c_;        // of pack_width triangles each; the last lanes repeat the last triangle
  std::vector<PackVec3> resting_;  // angles
  std::vector<PackVec3> start_;    // angles at the start of the step, turns included
  std::vector<double> turns_;      // of three hinges per triangle
};

}  // namespace tack
