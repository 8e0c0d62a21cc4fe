// Adhesion between the surfaces of different objects, integrated by clipping (clipped_pair.hpp):
//     E = sum over triangles t_a of a, t_b of b of E(t_a, t_b).
// It is a function of the positions alone: no area, side or normal is kept from the start of a
// step. Object b, whose planes are used, is chosen once: the one with the larger surface at rest,
// if equal the one with the larger cells. The closest distance of an edge or corner of a to a face
// of b is measured along the normal of that face.
//
// Contact pressure is not part of it: the barrier acts between close pairs of primitives as without
// adhesion (contact_term.hpp).
//
// Limits: pairs of an object with itself, regions, rods, particles and tangential adhesion are not
// integrated in this way. Every pair of triangles in range is clipped, so that an evaluation takes
// three to five times that of quadrature points at vertices.
#pragma once

#include <vector>

#include "framework/contact/clipped/clipped_laws.hpp"
#include "framework/contact/contact_system.hpp"
#include "framework/contact/surface_topology.hpp"
#include "framework/core/records.hpp"
#include "framework/core/term.hpp"

namespace tack {

class ClippedAdhesionTerm : public Term {
 public:
  // The system must outlive this term, and its configuration changes before that of this term.
  ClippedAdhesionTerm(const ContactSystem& system, ClippedLaws laws);

  double value(const VecX& x) const override;
  std::vector<StencilBatch> batches() const override;
  bool dynamic() const override { return true; }
  // With Projection::none the Hessian is a difference of the gradient, of fourth order.
  void derivatives(const VecX& x, Projection projection, double* gradient,
                   double* hessian) const override;
  void mark_debonding(const VecX& from, const VecX& to, std::vector<char>& vertices) const override;
  bool visit_energies(const VecX& x, const EnergyVisitor& visit) const override;
  void publish(Records& records) const override;

  void move_to(const VecX& x) override;
  void clear_caches() override;

  // The pairs of triangles that interact at the current configuration.
  int pair_count() const { return static_cast<int>(active_.size()); }

 private:
  // Indices of triangles, that of the object whose planes are used second.
  struct TrianglePair {
    int a, b, law;
    auto operator<=>(const TrianglePair&) const = default;
  };
  struct ActivePair {
    TrianglePair pair;
    std::array<int, 6> vertices;  // global; corners of a, then of b, in the order of their sides
    bool flipped_a, flipped_b;    // of two-sided triangles: the other side
  };

  void find_pairs();
  void add_pair(int triangle, int other, std::vector<TrianglePair>& pairs) const;
  bool has_planes(int object, int other) const;
  ActivePair orient(const VecX& x, const TrianglePair& pair) const;
  ClippedPair geometry(const VecX& x, const ActivePair& active) const;
  // Calls act(index, geometry, law) for every active pair of a chunk.
  template <class Act>
  void for_each_active(const VecX& x, int first, int last, const Act& act) const;

  const ContactSystem& system_;
  ClippedLaws laws_;
  SurfaceTopology topology_;
  std::vector<int> first_at_edge_, triangles_at_edge_;  // of each edge of the mesh
  std::vector<double> surface_area_;                    // per object, at rest [m^2]
  std::vector<std::array<double, 3>>
      heights_;                      // per triangle and edge, at rest [m]; 0: no boundary
  long version_ = -1;                // of the candidates from which the pairs were found
  std::vector<TrianglePair> pairs_;  // sorted
  std::vector<ActivePair> active_;   // in the order of the pairs
  mutable std::vector<int> batch_vertices_;
};

}  // namespace tack
