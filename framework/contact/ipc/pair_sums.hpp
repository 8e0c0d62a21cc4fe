// Contact model `ipc`: the sum of the law over all close pairs of primitives,
//     P = sum_(v, T) w_v phi(d(v, T)) + sum_(e, f) w_ef phi(d(e, f)),
// with pairs of vertices and rods, and of particles, among the first. Pairs do not know of each
// other: at an edge of the mesh several triangles count, so that strengths depend on the mesh.
// Weights:
//                 w_v                         w_ef
//   present_area  A_v, at the start of a step (A_e + A_f) / 4
//   rest_area     A_v / 4, at rest            (A_e + A_f) / 4
//   equal         A                           A
// A_v: tributary area of a vertex, A_e: area of an edge, a third of its triangles; A: mean
// tributary area of both objects. The quarter counts both sides of a pair, and points and edges,
// half each.
//
// With `inclusion_exclusion` a vertex counts a surface once (point_features.hpp); with rest_area
// this is the improved max formulation, but for edges: each pair of edges counts.
//
// Neighbours of one object that are close at rest press like all other pairs, except those that
// share a vertex.
// Sources: Li et al. 2020, Incremental Potential Contact (equal); Li et al. 2023, Convergent
// Incremental Potential Contact (rest_area, inclusion_exclusion).
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "framework/contact/contact_potential.hpp"
#include "framework/contact/stencils/stencil_search.hpp"

namespace tack {

enum class PairWeights { present_area, rest_area, equal };

class PairSums : public ContactPotential {
 public:
  PairSums(PairWeights weights, bool inclusion_exclusion)
      : weights_(weights), inclusion_exclusion_(inclusion_exclusion) {}

  // Pairs count on both sides, whatever `integrate` says.
  std::string refusal(ContactFeature feature, const PairSetup& pair) const override {
    switch (feature) {
      case ContactFeature::integration_side:
      case ContactFeature::both_sides:
      case ContactFeature::rods:
      case ContactFeature::particles: return "";
      default: return ContactPotential::refusal(feature, pair);
    }
  }
  PairLawIds add_laws(const PairSetup& pair, const PreparedLaws& laws, PairTable& table) override;
  std::unique_ptr<ContactPotential> isolated(int a, int b) const override;

  void clear_caches() override;
  void set_free(std::vector<char> free) override;
  void begin_step(const VecX& x, bool new_candidates) override;
  void set_candidates(const VecX& x) override;
  void find(const VecX& x, ContactSet& contacts) override;

 private:
  class VertexSearch;
  double vertex_weight(int vertex_index, int opposite) const;
  void choose_edges(const ChangedPrimitives* changed);

  PairWeights weights_;
  bool inclusion_exclusion_;
  FreeVertices free_;
  bool begun_ = false;  // edges have been chosen once
  std::optional<EdgePairs> edges_;
  std::vector<double> rest_area_;  // per global vertex, at rest [m^2]
  std::vector<double> mean_area_;  // of the vertices of each object, at rest [m^2]
  std::vector<double> edge_area_;  // per edge of the mesh [m^2]
};

}  // namespace tack
