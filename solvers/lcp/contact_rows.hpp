// Contacts as constraint rows: points with their nearest features of a surface, and pairs of edges,
// within range at the start of a step. The gap is signed: a point stays on its side of a surface
// until it goes around a boundary, also after it has crossed the surface. With an unsigned gap a
// point that has crossed would be pushed further in.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "geometry/broad_phase/broad_phase.hpp"
#include "framework/contact/contact_system.hpp"
#include "solvers/lcp/held_contacts.hpp"
#include "solvers/lcp/surface_features.hpp"

namespace tack {

struct ContactRow {
  // global: the point's, then those of the place that it faces; or of two edges.
  std::array<int, 4> vertices;
  // sum_i c_i x_i leads from the place to the point; 0 where there are fewer.
  std::array<double, 4> coefficients;
  // How many of the vertices are the point's: 1, or 2 of an edge.
  int own;
  Vec3 normal;                         // unit, towards where the point belongs
  double distance;                     // along it, signed, less the offsets of both [m]
  double gap;                          // that is kept [m]
  double mu;
  int object, opposite;                // whose point it is, and who it faces
  Vec3 force;                          // on the point: in the step before, later in this one [N]
  // Entry of HeldContacts among points (own 1) or edges; -1: none.
  int held;

  Vec3 moved(const VecX& way) const {  // way: 3n, displacements
    Vec3 sum = Vec3::Zero();
    for (int i = 0; i < 4; ++i) sum += coefficients[i] * vertex(way, vertices[i]);
    return sum;
  }
};

struct ContactRows {
  std::vector<ContactRow> rows;
  HeldContacts held;  // what the next step is to know; forces are those of the step before
};

// Primitives within so many margins of each other have rows from the start of a step; the rest, if
// it meets on the way (impact_rows.hpp).
constexpr double near_in_margins = 2;
// Fraction of the margin that is kept between edges, which only see to it that nothing passes
// between the points.
constexpr double part_for_edges = 0.5;
// Below this cosine a point is beside a surface rather than on one side of it.
constexpr double beside = 0.2;

// The coefficient of friction between two objects.
double friction_between(const ContactSystem& system, int a, int b);

// At most how far one of these vertices goes against one of those; way: 3n, or empty.
template <size_t A, size_t B>
double relative_way(const VecX& way, const std::array<int, A>& a, const std::array<int, B>& b) {
  if (way.size() == 0) return 0;
  double most = 0;
  for (const int i : a)
    for (const int j : b) most = std::max(most, (vertex(way, i) - vertex(way, j)).squaredNorm());
  return std::sqrt(most);
}

class ContactFinder {
 public:
  // Both must outlive it. margin: the gap that points keep from surfaces; edges keep half of it
  // from each other [m].
  ContactFinder(const ContactSystem& system, double margin);

  // Finds contacts near at x (3n); before: those of the last step. way: how far vertices have gone
  // since (3n); empty: nowhere.
  ContactRows find(const VecX& x, const VecX& way, const HeldContacts& before);

 private:
  struct Chunk {
    std::vector<ContactRow> rows;
    std::vector<HeldPoint> points;
    std::vector<HeldEdges> edges;
  };
  void add_points(const Candidates& candidates, int first, int last, const VecX& x, const VecX& way,
                  double reach, const HeldContacts& before, Chunk& out) const;
  void add_edges(int a, int b, const VecX& x, const VecX& way, const HeldContacts& before,
                 const std::vector<HeldPoint>& sides, Chunk& out) const;
  double side_of_edges(const NearEdges& near, const VecX& x, const std::vector<HeldPoint>& sides,
                       const HeldEdges* held) const;
  bool share_vertex(int triangle, int other) const;
  double strayed(const HeldContacts& before, const VecX& way) const;

  const ContactSystem& system_;
  const ContactSurface& surface_;
  SurfaceFeatures features_;
  double margin_;
  BroadPhase broad_phase_;
};

}  // namespace tack
