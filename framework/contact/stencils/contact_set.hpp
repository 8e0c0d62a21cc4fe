// Active contact stencils of one configuration, as homogeneous arrays by kind. Point stencils are
// reduced to features: (p, v), (p, e0, e1), (p, t0, t1, t2), with unclamped distances. An interior
// point p has fixed barycentric coordinates in a triangle (surface_overlap.hpp).
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <vector>

#include "framework/contact/laws/pair_table.hpp"
#include "geometry/broad_phase/candidates.hpp"
#include "geometry/mesh/collision_mesh.hpp"

namespace tack {

class RestGaps;

template <int K>
struct ContactStencil {
  std::array<int, K> vertices;  // global
  int law;                      // of the pair table
  // Of a vertex: its contact point, below ContactSet::point_count; -1: one of its own. Stencils of
  // a contact point have one vertex, opposite object and law. Of two edges: -1.
  int point;
  double weight;  // area x multiplicity [m^2]; may be negative for points
};

template <int K>
using ContactStencils = std::vector<ContactStencil<K>>;  // sorted by law

// Stencil of an interior quadrature point: the vertices of its triangle come first.
template <int K>
struct InteriorStencil {
  std::array<int, K> vertices;  // global; the first three are the corners of the triangle
  int law;                      // of the pair table
  double weight;                // area x multiplicity [m^2]; may be negative
  Vec3 inside;                  // barycentric coordinates of the point
  int point;  // contact point and index of the interior point, below interior_point_count
};

template <int K>
using InteriorStencils = std::vector<InteriorStencil<K>>;  // sorted by law

struct ContactSet {
  ContactStencils<2> point_point;
  ContactStencils<3> point_edge;
  ContactStencils<4> point_triangle;
  ContactStencils<4> edge_edge;
  InteriorStencils<4> interior_point;
  InteriorStencils<5> interior_edge;
  InteriorStencils<6> interior_triangle;
  std::vector<double> mollifier_threshold;  // eps_x of each edge-edge stencil [m^4]
  int point_count = 0;                      // contact points of vertices, by (vertex, object, law)
  int interior_point_count = 0;             // contact points of interior points

  std::size_t size() const {
    return point_point.size() + point_edge.size() + point_triangle.size() + edge_edge.size() +
           interior_point.size() + interior_edge.size() + interior_triangle.size();
  }
};

// Constant properties of the contact surfaces, valid for the whole run.
struct ContactSurface {
  CollisionMesh mesh;
  std::vector<double> edge_area;  // per edge of the mesh: a third of its triangles at rest [m^2]
  std::vector<char> two_sided;    // per triangle of the mesh: whether it is of a sheet
  std::vector<double> rod_width;  // per object: of its edges that are in no triangle [m]
  std::vector<double> particle_radius;  // per object: of its points that are in no edge [m]
  VecX rest;                            // rest configuration (3n) [m]
  // Gaps at rest within each object; null: no law is cut down.
  std::shared_ptr<const RestGaps> rest_gaps;

  template <std::size_t K>
  bool is_particle(const std::array<int, K>& vertices) const {
    return K == 1 &&
           std::binary_search(mesh.codim_points.begin(), mesh.codim_points.end(), vertices[0]);
  }
};

// Returns the candidates between objects a and b.
Candidates candidates_between(const CollisionMesh& mesh, const Candidates& candidates, int a,
                              int b);

// Smallest gaps among the candidates [m]: distances less the offset of the two primitives
// (offset_between, rest_neighbours.hpp). Infinity without candidates.
struct SmallestGaps {
  double of_all = 0;
  double between_objects = 0;  // of different objects
};
SmallestGaps smallest_gaps(const ContactSurface& surface, const PairTable& pairs,
                           const Candidates& candidates, const VecX& x);

}  // namespace tack
