// Weights of a vertex of a rod, or of a particle, towards each triangle of another surface:
// fractions of its tributary area, taken at the start of the step. They are continuous in all
// positions: the law acts with the weighted sum of point_features.hpp, so that nothing jumps when
// another triangle becomes the nearest one or is no longer visible. From step to step:
// weight_relaxation.hpp.
//
// A triangle j that the point is in front of is a seed triangle, with the strength
//     L_j = thin(n_j) / thin  g(beyond_j)  f(c_j):
//   thin(n_j)  tributary area towards its normal (lagged_surface.hpp);
//   g          falls from 1 above the surface to 0 half a width past a crease or boundary of it;
//   c_j        height / distance; f rises from 0 in the plane of j to 1 at 0.5 (on the point's own
//   object
//              from 0.15 to 0.65: neighbours on a slightly hollow surface are not opposite).
// A triangle i has the weight
//     s_i = max_j k_ij L_j psi(e_ij / min_j e_ij),   e_ij = d_j / (k_ij f(c_j) z(d_j)),
// over its seeds: the nearest, at the distance d_j, and others while they are hardly farther (psi
// falls from 1 at 1 to 0 at 1.3; z falls to 0 at the end of the range).
//   k_ij       whether i belongs to the patch of seed j: the largest value, over paths along edges
//   from j
//              by triangles within range, of the least k on the path; k falls with the angle
//              between the normals from 1 at 30 degrees to 0 at 70.
// Triangles beyond the range at the start of the step take the seeds whose normals are close to
// theirs, and are their own seeds if there is none.
#pragma once

#include <span>
#include <vector>

#include "framework/contact/lagged_surface.hpp"

namespace tack {

// Weight of a triangle for a point.
struct TriangleWeight {
  double share;  // s_i: fraction of the point's tributary area
  Vec3 normal, centre;
  bool two_sided;
  double distance;  // from the point [m]
};

// Returns how far two adjacent triangles count as one patch, 0 to 1. The faces of a hollow are two
// patches: each has its own side towards a point in it.
double one_surface(const TriangleWeight& a, const TriangleWeight& b);

class CodimensionalViewer {
 public:
  CodimensionalViewer(const CollisionMesh& mesh, const LaggedSurface& held)
      : mesh_(mesh), held_(held) {}

  // Returns the weights of a vertex for triangles of one object that may come near; range: of the
  // law [m].
  std::vector<TriangleWeight>& look(int vertex_index, std::span<const int> triangles, double range);

 private:
  struct Seen {
    // L_j, d_j [m], z, d_j / (f z) [m]: infinite if it does not lead.
    double strength, distance, reach, away;
  };
  // Closest feature of a triangle: one of three vertices, three edges, or the face.
  struct Foot {
    int triangle, feature;
    double distance, off;  // m; off: the component of the distance in the plane of the triangle
  };
  // Triangles around a corner: the largest sharpness on the path from the first one, and that of
  // edges.
  struct Side {
    int triangle;
    Vec3 normal;
    double sharpness;
  };
  struct Link {
    int from, to;
    double sharpness;
  };
  Seen see(int vertex_index, int triangle, double range);
  Foot foot(const Vec3& p, int triangle) const;
  std::pair<Foot, double> nearer(const Vec3& p, const Foot& from);
  double beyond(const Vec3& p, Foot at);
  double beyond_corner(const Vec3& p, const Foot& at);
  void find_fan(int triangle, int corner);
  int across(int triangle, int side) const;
  Vec3 turned_like(int triangle, const Vec3& normal) const;
  double sharpness(int triangle, int side, const Vec3& normal, const Vec3& beside) const;
  void find_neighbours(std::span<const int> triangles, double range);
  void lead(int leader, double range, double* way);

  const CollisionMesh& mesh_;
  const LaggedSurface& held_;
  double half_width_ = 0;  // m
  std::vector<Side> fan_;
  std::vector<Link> links_;
  std::vector<Seen> seen_;
  std::vector<int> leaders_;
  std::vector<std::array<int, 3>> uses_;        // of edges: two vertices, a triangle of the list
  std::vector<std::array<int, 2>> neighbours_;  // into the list, by the first
  std::vector<int> neighbour_start_;
  std::vector<std::pair<double, int>> open_;
  std::vector<double> ways_;     // k_ij of each seed
  std::vector<double> nearest_;  // min_j e_ij [m]
  std::vector<TriangleWeight> shares_;
};

}  // namespace tack
