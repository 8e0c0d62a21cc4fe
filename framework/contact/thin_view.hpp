// What a vertex of a rod, or a particle, has of its area towards each triangle of another surface, as the step found
// them. All of it is continuous in where things are: the law acts on it with the sum of point_features.hpp, for
// shares, so that nothing jumps when another triangle comes to be the nearest one, or is seen no more. From step to step:
// share_memory.hpp.
//
// A triangle j that the point is in front of leads, with the strength
//     L_j = thin(n_j) / thin  g(beyond_j)  f(c_j),
// the area towards its normal (held_surface.hpp); g falls from 1 above the surface to 0 half a width beyond a crease or
// boundary of it; c_j = height / distance, and f rises from 0 in its plane to 1 at 0.5 (on the point's own object from 0.15 to 0.65:
// neighbours on a slightly hollow surface are no other side). A triangle i has
//     s_i = max_j k_ij L_j psi(e_ij / min_j e_ij),   e_ij = d_j / (k_ij f(c_j) z(d_j)),
// of those that lead it: the nearest, d_j, and others while they are hardly farther (psi falls from 1 at 1 to 0 at 1.3; z
// to 0 at the end of the range).
// k_ij says whether i belongs to the surface that j leads: from j it is reached over edges by triangles within range
// whose normals are close to that of j (k falls from 1 at 30 degrees to 0 at 70), the least of which counts, on the best way.
// What is beyond the range when the step begins is led by what its normal is close to, and by itself if there is nothing.
#pragma once

#include <span>
#include <vector>

#include "framework/contact/held_surface.hpp"

namespace tack {

// Of a triangle towards a point.
struct TriangleShare {
  double share;  // of the point's area, s_i
  Vec3 normal, centre;
  bool two_sided;
  double distance;  // of the point [m]
};

// How far two triangles that meet count as one surface, 0 to 1: not where they make a hollow, of which each has its own side
// towards a point in it.
double one_surface(const TriangleShare& a, const TriangleShare& b);

class ThinViewer {
 public:
  ThinViewer(const CollisionMesh& mesh, const HeldSurface& held) : mesh_(mesh), held_(held) {}

  // Of a vertex towards triangles of one object that may come near; range: of the law [m].
  std::vector<TriangleShare>& look(int vertex_index, std::span<const int> triangles, double range);

 private:
  struct Seen {
    double strength, distance, reach, away;  // L_j, d_j [m], z, d_j / (f z) [m]: infinite if it does not lead
  };
  // Where a triangle is nearest: one of its three vertices, three edges, or its face.
  struct Foot {
    int triangle, feature;
    double distance, off;  // m; off: of it, what is along the triangle
  };
  // Of the triangles around a corner: the sharpness over which they are reached from the first one, and that of edges between them.
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
  const HeldSurface& held_;
  double half_width_ = 0;  // m
  std::vector<Side> fan_;
  std::vector<Link> links_;
  std::vector<Seen> seen_;
  std::vector<int> leaders_;
  std::vector<std::array<int, 3>> uses_;        // of edges: two vertices, a triangle of the list
  std::vector<std::array<int, 2>> neighbours_;  // into the list, by the first
  std::vector<int> neighbour_start_;
  std::vector<std::pair<double, int>> open_;
  std::vector<double> ways_;     // k_ij of each leader that was asked
  std::vector<double> nearest_;  // min_j e_ij [m]
  std::vector<TriangleShare> shares_;
};

}  // namespace tack
