// Fans of dihedral edges of one shape. Each has the energy 1/2 a^T C a, a its angles minus those at
// rest, C from dihedral_stiffness.hpp. pack_width fans are computed at once, one per lane.
//
// The angle of a dihedral edge lies between the normals n1, n2 of its sides. It is positive if both
// apexes rise.
// On each side, m points from the edge e to the apex, h is the height, N_k are barycentric
// coordinates, and A = sum_k (m . grad N_k) x_k, B = sum_k (e . grad N_k) x_k. With dx the change
// of the vertices,
//     d angle = sum over sides of A(dx) . n,
//     d2 angle = -sum over sides of 2 (A.m) (A.n) + (B.n) (2 (A.e) + B.m).
// The factors p, r of each product have orthogonal coefficients, so that
// p r = ((k p + r/k)^2 - (k p - r/k)^2) / 4 separates its positive and negative part, k^2 the ratio
// of their lengths. A projected Hessian is the definite part with C plus those parts of the
// moments.
//
// Angles may pass pi: the value nearest to the angle at the start of the step counts.
//
// Plastic fans. With a yield moment, a are the elastic trial angles, those above minus the plastic
// angles p of the start of the step, and t = sqrt(a^T C a) [sqrt(J)] is limited to Y + H g, g the
// plastic flow in the same unit:
//     phi(t) = t^2 / 2 up to Y;  (t - g)^2 / 2 + Y g + H g^2 / 2,  g = (t - Y) / (1 + H), beyond,
// the least over all flows of stored energy plus plastic work. Flow is along a, so that the return
// mapping is p += (g / t) a. For a sheet curved about one axis, t^2 = D A k^2, A the area of the
// fan, and Y = M sqrt(A / D) is its yield moment M per length. In general the yield surface is that
// of the bending energy; at nu = 1/2, Ilyushin's for plates in bending.
// Sources: Ilyushin 1956; Ortiz and Stainier 1999 for the incremental potential.
#pragma once

#include "energies/shell/dihedral_stiffness.hpp"
#include "framework/core/term.hpp"
#include "geometry/pack.hpp"

namespace tack {

// Plastic history of the fans of one shape: per fan its plastic angles, edge by edge, and its
// accumulated flow [sqrt(J)].
struct FanFlow {
  const double* angles;
  const double* flow;
};

class FanStencils final : public StencilRanges {
 public:
  // fans, c: `count` fans of one shape, with their stiffnesses.
  FanStencils(const DihedralFan* fans, const FanMatrix* c, int count);

  StencilBatch batch() const { return {shape_.arity(), count_, vertices_.data()}; }
  int edge_count() const { return shape_.edge_count * count_; }

  // Sets the angles without moments to those at `rest`; initially, the flat sheet has no moments.
  void set_rest(const VecX& rest);
  // turns: per dihedral edge of each fan, the whole turns at x in addition to the angle in (-pi,
  // pi].
  void begin_step(const VecX& x, const double* turns);
  void turns(const VecX& x, double* turns) const;

  // Angles of each dihedral edge of each fan: those at x, next to those at the start of the step;
  // and those without moments.
  void angles(const VecX& x, double* angles) const;
  void rest_angles(double* angles) const;
  void set_rest_angles(const double* angles);
  // Returns 1/2 a^T C a of angles a [J].
  double energy_of(const double* angles) const;

  // Makes the fans plastic. yields: Y of each fan [sqrt(J)]; hardening: H.
  void set_yield(const double* yields, double hardening);
  void set_flow(const FanFlow& stored);
  // Writes the plastic angles and the accumulated flow after a step to x.
  void flow(const VecX& x, double* angles, double* flow) const;
  // Returns the plastic work of a step to x [J].
  double dissipated(const VecX& x) const;
  int count() const { return count_; }

  double value(const VecX& x) const;
  void range_derivatives(const VecX& x, Projection projection, int first, int last,
                         double* gradient, double* hessian) const override;

 private:
  struct Side {
    PackVec3 m, n;
    std::array<Pack, 3> alpha;  // m . grad N of the vertex in the middle, the tip and the apex
  };
  struct DihedralEdge {
    PackVec3 e;  // from the middle
    Pack inverse_length;
    std::array<Side, 2> sides;  // left and right
    Pack angle;                 // in (-pi, pi]
  };
  using Corners = std::array<PackVec3, 1 + ring_max>;
  using DihedralEdges = std::array<DihedralEdge, fan_edges_max>;
  using Angles = std::array<Pack, fan_edges_max>;

  int packs() const { return static_cast<int>(resting_.size()); }
  int lanes(int pack) const { return std::min(pack_width, count_ - pack * pack_width); }
  // Index of an edge of a fan in arrays of angles; further lanes repeat the last fan.
  int entry(int pack, int lane, int i) const {
    return shape_.edge_count * (pack * pack_width + std::min(lane, lanes(pack) - 1)) + i;
  }
  const Pack& c(int pack, int i, int k) const {
    return c_[(static_cast<size_t>(pack) * shape_.edge_count + i) * shape_.edge_count + k];
  }
  void corners(int pack, const VecX& x, Corners& out) const;
  void find_edges(const Corners& x, DihedralEdges& out) const;
  // Nearest to those at the start of the step.
  Pack unwound(int pack, int i, const Pack& angle) const;
  void derivatives(int pack, const VecX& x, Projection projection, double* gradient,
                   double* hessian) const;
  bool plastic() const { return !plastic_.empty(); }
  double plastic_value(const VecX& x) const;
  // Turns derivatives of the energy t^2 / 2 of fans first to last - 1 into those of phi(t).
  void let_flow(const VecX& x, int first, int last, double* gradient, double* hessian) const;
  // Trial state of plastic fans: elastic angles, t and g.
  struct Trial {
    Angles a;
    Pack size, flow;
  };
  Trial trial(int pack, const VecX& x) const;
  // g for t = size.
  Pack flowing(const Pack& size, const Pack& yield) const {
    return select(size > yield, (size - yield) / (1 + hardening_), 0);
  }
  void add_moment(const DihedralEdge& dihedral, int i, const Pack& moment, Projection projection,
                  Pack* slots) const;

  FanShape shape_;
  int count_;
  std::vector<int> vertices_;
  std::vector<Pack> c_;  // of pack_width fans each; the last lanes repeat the last fan
  std::vector<Angles> resting_;
  std::vector<Angles> start_;  // at the start of the step, turns included
  // Plastic fans only; else empty. resting_ contains p.
  std::vector<Angles> plastic_, unstressed_;  // p, and angles at rest before any flow
  std::vector<Pack> initial_, yielded_;       // Y before any flow, and accumulated flow [sqrt(J)]
  double hardening_ = 0;                      // H
};

}  // namespace tack
