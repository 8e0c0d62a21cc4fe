// Nearest features of a surface for points and edges of other surfaces: local minima of the
// distance, each with the unit normal there and the side of the surface.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "framework/contact/surface_topology.hpp"
#include "geometry/broad_phase/candidates.hpp"

namespace tack {

// A point and the place on a triangle, edge or vertex that it is nearest to.
struct NearPoint {
  int point;
  int triangle;                  // that the place is in
  int count;                     // corners that it is a mean of: 3 in a triangle, 2, 1
  std::array<int, 3> corners;    // global vertices
  std::array<double, 3> weights; // of the place
  double distance;               // m
  Vec3 normal;                   // unit, from the place to the point
  // Cosine of the angle between it and the surface's normal there; 0 at a boundary, which has no
  // sides.
  double facing;
};

// Two edges, nearest to each other inside both.
struct NearEdges {
  int a, b;                      // edges of the mesh
  // The places are (1 - at) of the first vertex of either and at of the second.
  Vec2 at;
  double distance;               // m
  Vec3 normal;                   // unit, from b to a
  // As above: of -normal and the surface of a, of normal and that of b.
  double facing_a, facing_b;
};

class SurfaceFeatures {
 public:
  // The surface must outlive it.
  explicit SurfaceFeatures(const ContactSurface& surface);

  // Finds, among candidates first .. last - 1 of one point and one object, those nearer than reach
  // [m].
  void near_point(const Candidates& candidates, int first, int last, const VecX& x, double reach,
                  std::vector<NearPoint>& out) const;
  // False if the two edges are not nearest inside both, or nearly parallel.
  bool near_edges(int a, int b, const VecX& x, NearEdges& out) const;

  const SurfaceTopology& topology() const { return topology_; }
  bool two_sided(int triangle) const { return surface_.two_sided[triangle] != 0; }
  // Triangles at an edge of the mesh.
  bool two_sided_at(int edge) const;
  Vec3 normal_of(int triangle, const VecX& x) const;  // unit; zero of one without area

 private:
  std::span<const int> triangles_at_edge(int edge) const {
    return {edge_triangles_.data() + edge_start_[edge],
            edge_triangles_.data() + edge_start_[edge + 1]};
  }
  Vec3 normal_at(const NearPoint& near, const VecX& x) const;
  Vec3 normal_at_edge(int edge, const VecX& x) const;
  int triangles_at(const NearPoint& near) const;

  const ContactSurface& surface_;
  SurfaceTopology topology_;
  std::vector<int> edge_start_, edge_triangles_;  // the triangles at each edge of the mesh
  // Per global vertex: of an edge that is not in two triangles.
  std::vector<char> boundary_;
};

}  // namespace tack
