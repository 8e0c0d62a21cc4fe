// Contacts as constraint rows: points with their nearest features of a surface, and pairs of edges,
// if they are near each other at the start of a step.
// Key idea: the gap is signed. A point keeps its side of a surface until it goes around a boundary,
// also after it has crossed the surface; otherwise the constraint would push a point that has
// crossed further in.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "geometry/broad_phase/broad_phase.hpp"
#include "framework/contact/contact_system.hpp"
#include "solvers/lcp/stored_contacts.hpp"
#include "solvers/lcp/surface_features.hpp"

namespace tack {

struct ContactRow {
  // Global ids: of the point, then of the opposite feature; or of two edges.
  std::array<int, 4> vertices;
  // sum_i c_i x_i is the vector from the feature to the point; 0 for unused entries
  std::array<double, 4> coefficients;
  int own;          // number of leading vertices that are the point's: 1, or 2 of an edge
  Vec3 normal;      // unit, towards the side that the point belongs to
  double distance;  // signed, along the normal, less the offsets of both objects [m]
  double gap;       // gap that the constraint keeps [m]
  double mu;
  int object, opposite;  // object of the point, and object of the feature
  Vec3 force;            // force on the point: of the last step, once solved of this step [N]
  int stored;  // index in StoredContacts::points (own = 1) or StoredContacts::edges; -1: none

  Vec3 moved(const VecX& displacement) const {  // displacement: 3n [m]
    Vec3 sum = Vec3::Zero();
    for (int i = 0; i < 4; ++i) sum += coefficients[i] * vertex(displacement, vertices[i]);
    return sum;
  }
};

struct ContactRows {
  std::vector<ContactRow> rows;
  StoredContacts stored;  // stored for the next step; its forces are those of the last step
};

// Search radius, in margins: pairs within it have rows from the start of a step. Other pairs get
// rows if they meet during the step (impact_rows.hpp).
constexpr double search_radius_in_margins = 2;
// Gap kept between edges, as a fraction of the margin. Edge rows only prevent crossings between
// points.
constexpr double edge_gap_fraction = 0.5;
// Cosine below which a point lies beside a surface, so that it has no side.
constexpr double beside = 0.2;

// Returns the coefficient of friction between objects a and b [1].
double friction_between(const ContactSystem& system, int a, int b);

// Returns an upper bound of the relative displacement of vertices `a` against vertices `b` [m].
// displacement: 3n, or empty for none.
template <size_t A, size_t B>
double relative_displacement(const VecX& displacement, const std::array<int, A>& a,
                             const std::array<int, B>& b) {
  if (displacement.size() == 0) return 0;
  double most = 0;
  for (const int i : a)
    for (const int j : b) {
      const Vec3 relative = vertex(displacement, i) - vertex(displacement, j);
      most = std::max(most, relative.squaredNorm());
    }
  return std::sqrt(most);
}

class ContactFinder {
 public:
  // Both arguments must outlive the finder. margin: gap kept between points and surfaces [m]; edges
  // keep half of it.
  ContactFinder(const ContactSystem& system, double margin);

  // Returns the contacts near at x (3n) and those stored in `before`. displacement: of the vertices
  // since `before` (3n) [m]; empty: none.
  ContactRows find(const VecX& x, const VecX& displacement, const StoredContacts& before);

 private:
  struct Chunk {
    std::vector<ContactRow> rows;
    std::vector<StoredPoint> points;
    std::vector<StoredEdges> edges;
  };
  void add_points(const Candidates& candidates, int first, int last, const VecX& x,
                  const VecX& displacement, double search_radius, const StoredContacts& before,
                  Chunk& out) const;
  void add_edges(int a, int b, const VecX& x, const VecX& displacement,
                 const StoredContacts& before, const std::vector<StoredPoint>& sides,
                 Chunk& out) const;
  double side_of_edges(const NearEdges& near, const VecX& x, const std::vector<StoredPoint>& sides,
                       const StoredEdges* stored) const;
  bool share_vertex(int triangle, int other) const;
  double displaced_depth(const StoredContacts& before, const VecX& displacement) const;

  const ContactSystem& system_;
  const ContactSurface& surface_;
  SurfaceFeatures features_;
  double margin_;
  BroadPhase broad_phase_;
};

}  // namespace tack
