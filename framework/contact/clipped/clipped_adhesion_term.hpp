// Adhesion between surfaces, integrated by clipping (clipped_pair.hpp):
//     E = sum over triangles t_a of a, t_b of b of E(t_a, t_b).
// It is a function of the positions alone: no area, side or normal is kept from the start of a
// step. Object b, whose planes are used, is chosen once (triangle_pairs.hpp). The closest distance
// of an edge or corner of a to a face of b is measured along the normal of that face.
//
// Contact pressure is not part of it: the barrier acts between close pairs of primitives as without
// adhesion (contact_term.hpp).
//
// Two lists of pairs of triangles, the second a part of the first:
//   candidates  whose fat AABBs are within range; found again with those of the broad phase
//   close       that can interact while vertices move by less than a margin from where each was at
//               the start of the step, or last left its margin
// Close pairs are the stencils: the pattern of the Hessian seldom changes within a step. Those that
// do not interact at a configuration have no energy there.
//
// Within an object, and where both sides integrate, planes of both are used in turn, with half of
// the law each. Neighbours at rest (rest_neighbours.hpp) do not adhere. Regions have their laws
// (triangle_pairs.hpp).
//
// Limits: rods, particles and bonds are not integrated in this way.
#pragma once

#include <vector>

#include "framework/contact/clipped/triangle_pairs.hpp"
#include "framework/contact/points/contact_points.hpp"
#include "framework/contact/contact_system.hpp"
#include "framework/contact/surface/surface_topology.hpp"
#include "framework/core/force_point.hpp"
#include "framework/core/records.hpp"
#include "framework/core/term.hpp"

namespace tack {

class ClippedAdhesionTerm : public Term, public ForcePoints {
 public:
  // The system must outlive this term, and its configuration changes before that of this term.
  ClippedAdhesionTerm(const ContactSystem& system, ClippedLaws laws);

  double value(const VecX& x) const override;
  std::vector<StencilBatch> batches() const override;
  bool dynamic() const override { return true; }
  // With Projection::none the Hessian is a difference of the gradient, of fourth order.
  void derivatives(const VecX& x, Projection projection, double* gradient,
                   double* hessian) const override;
  void mark_debonding(const VecX& from, const VecX& to, std::vector<char>& marks) const override;
  bool visit_energies(const VecX& x, const EnergyVisitor& visit) const override;
  void publish(Records& records) const override;

  void begin_step(const StepStart& start) override;
  void move_to(const VecX& x) override;
  void clear_caches() override;

  // Appends the contact points of wanted laws at x, where the term must be: one per pair of
  // triangles. They carry no pressure. first_index: of the first close pair, for point.
  void add_points(const ContactPointsRequest& request, int first_index, ContactPoints& out) const;

  // Visits the pairs of triangles that overlap at x, where the term must be.
  void visit_points(const VecX& x, std::string_view summand,
                    const ForcePointVisitor& visit) const override;

  // Close pairs of triangles.
  int pair_count() const { return static_cast<int>(close_.size()); }

 private:
  struct ClosePair {
    TrianglePair pair;
    std::array<int, 6> vertices;  // global; corners of a, then of b
    bool two_sided, two_sided_b;  // whether one of the triangles is, and b
    std::array<bool, 3> boundary_a{}, owns_b{};
    std::array<double, 3> strip_b{};     // m
    bool close = false, inside = false;  // CloseTriangles::Lanes
    bool operator==(const ClosePair&) const = default;
    // Law, and whether b has strips.
    std::pair<int, bool> kind() const { return {pair.law, strip_b != std::array<double, 3>{}}; }
  };
  struct Oriented;

  void find_pairs();
  void find_close_pairs(const VecX& x);
  bool test_pairs(const std::vector<char>& moved);
  void list_close_pairs(const VecX& x);
  ClosePair with_edges(const TrianglePair& pair) const;
  void orient(const VecX& x, ClosePair& close) const;
  Oriented geometry(const VecX& x, const ClosePair& close) const;
  static Vec3 normal_of_b(const VecX& x, const ClosePair& close);
  static double mean_gap(const VecX& x, const ClosePair& close);
  template <class Packed, class Single>
  void for_each_close(const VecX& x, int first, int last, const Packed& packed,
                      const Single& single) const;
  static void exact_hessian(const ClippedPair& pair, const ClippedLaw& law,
                            ClipIntegrator& integrator, Mat18& hessian);
  std::vector<ClippedIntegral> integrals(const VecX& x) const;
  const std::vector<Vec18>& gradients(const VecX& x) const;

  const ContactSystem& system_;
  ClippedLaws laws_;
  SurfaceTopology topology_;
  StripEdges edges_;
  TrianglePairFinder finder_;
  double margin_ = 0;               // of close pairs [m]
  long version_ = -1;               // of the candidates from which the pairs were found
  std::vector<ClosePair> pairs_;    // candidates, by kind
  std::vector<int> pair_vertices_;  // of the pairs, ascending
  std::vector<ClosePair> close_;    // by kind, then those inside, then in the order of the pairs
  VecX close_at_;                   // positions at which they were tested (3n) [m]
  mutable std::vector<int> batch_vertices_;
  mutable std::vector<ClipIntegrator> integrators_;  // one per chunk: they keep their memory
  mutable VecX value_at_;                            // positions of `value_` (3n) [m]
  mutable double value_ = 0;                         // J
  mutable bool keeps_gradients_ = false;             // records have asked for them
  mutable VecX gradients_at_;                        // positions of `gradients_` (3n) [m]
  mutable std::vector<Vec18> gradients_;             // of each close pair, for records
};

}  // namespace tack
