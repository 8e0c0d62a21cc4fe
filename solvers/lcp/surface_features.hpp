// Nearest features of a surface to points and edges of other surfaces: the local minima of the
// distance, each with its unit normal and the side of the surface that it lies on.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "framework/contact/surface/surface_topology.hpp"
#include "geometry/broad_phase/candidates.hpp"

namespace tack {

// A point and its nearest position on a triangle, edge or vertex.
struct NearPoint {
  int point;
  int triangle;                   // that contains the nearest position
  int count;                      // number of corners: 3 in a triangle, 2 on an edge, 1 at a vertex
  std::array<int, 3> corners;     // global vertices
  std::array<double, 3> weights;  // barycentric
  double distance;                // m
  Vec3 normal;                    // unit, from the nearest position to the point
  double facing;  // cosine of normal and surface normal; 0 at a boundary, which has no sides
};

// Two edges whose nearest positions are inside both.
struct NearEdges {
  int a, b;         // edges of the mesh
  Vec2 at;          // per edge, the position is (1 - at) * first vertex + at * second vertex
  double distance;  // m
  Vec3 normal;      // unit, from b to a
  // Cosine of -normal with the surface normal at a, of normal with that at b.
  double facing_a, facing_b;
};

class SurfaceFeatures {
 public:
  // The surface must outlive it.
  explicit SurfaceFeatures(const ContactSurface& surface);

  // Appends the features nearer than `search_radius` [m] among candidates first .. last - 1, which
  // have one point and one object.
  void near_point(const Candidates& candidates, int first, int last, const VecX& x,
                  double search_radius, std::vector<NearPoint>& out) const;
  // Returns false if the nearest positions are not inside both edges, or the edges are nearly
  // parallel.
  bool near_edges(int a, int b, const VecX& x, NearEdges& out) const;

  const SurfaceTopology& topology() const { return topology_; }
  bool two_sided(int triangle) const { return surface_.two_sided[triangle] != 0; }
  // Returns true if a triangle at this edge of the mesh is two-sided.
  bool two_sided_at(int edge) const;
  Vec3 normal_of(int triangle, const VecX& x) const;  // unit; zero for a triangle without area

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
  std::vector<int> edge_start_, edge_triangles_;  // triangles at each edge of the mesh
  std::vector<char> boundary_;  // per global vertex: it is at an edge that is not in two triangles
};

}  // namespace tack
