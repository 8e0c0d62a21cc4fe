// The active contact stencils of one configuration, as homogeneous arrays by kind. Point stencils
// are already reduced to features: (p, v), (p, e0, e1), (p, t0, t1, t2), with unclamped distances.
// The point of a sample is a fixed one inside a triangle (surface_overlap.hpp).
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <vector>

#include "framework/contact/pair_table.hpp"
#include "geometry/broad_phase/candidates.hpp"
#include "geometry/mesh/collision_mesh.hpp"

namespace tack {

class RestGaps;

template <int K>
struct ContactStencil {
  std::array<int, K> vertices;  // global
  int law;                      // of the pair table
  double weight;                // area x multiplicity [m^2]; may be negative for points
};

template <int K>
using ContactStencils = std::vector<ContactStencil<K>>;  // sorted by law

// Stencil of a point inside a triangle: the vertices of that triangle come first.
template <int K>
struct SampleStencil {
  std::array<int, K> vertices;  // global; the first three those of the point's triangle
  int law;                      // of the pair table
  double weight;                // area x multiplicity [m^2]; may be negative
  Vec3 inside;                  // the point's barycentric coordinates
  int sample;                   // whose stencil this is
};

template <int K>
using SampleStencils = std::vector<SampleStencil<K>>;  // sorted by law

struct ContactSet {
  ContactStencils<2> point_point;
  ContactStencils<3> point_edge;
  ContactStencils<4> point_triangle;
  ContactStencils<4> edge_edge;
  SampleStencils<4> sample_point;
  SampleStencils<5> sample_edge;
  SampleStencils<6> sample_triangle;
  std::vector<double> mollifier_threshold;  // eps_x of each edge-edge stencil [m^4]

  std::size_t size() const {
    return point_point.size() + point_edge.size() + point_triangle.size() + edge_edge.size() +
           sample_point.size() + sample_edge.size() + sample_triangle.size();
  }
};

// Constant properties of the contact surfaces, valid for the whole run.
struct ContactSurface {
  CollisionMesh mesh;
  std::vector<double> edge_area;        // per edge of the mesh [m^2]
  std::vector<char> two_sided;          // per triangle of the mesh: of a sheet
  std::vector<double> rod_width;        // per object: of its edges that are in no triangle [m]
  std::vector<double> particle_radius;  // per object: of its points that are in no edge [m]
  VecX rest;                            // rest configuration
  std::shared_ptr<const RestGaps> rest_gaps;  // of each object to itself; null: no law is cut down

  template <std::size_t K>
  bool is_particle(const std::array<int, K>& vertices) const {
    return K == 1 &&
           std::binary_search(mesh.codim_points.begin(), mesh.codim_points.end(), vertices[0]);
  }
};

// The candidates between objects a and b.
Candidates candidates_between(const CollisionMesh& mesh, const Candidates& candidates, int a,
                              int b);

// Smallest gaps among the candidates [m]: the distance less the offset that counts between the two
// primitives (filled_between, rest_neighbours.hpp). Infinity without candidates.
struct SmallestGaps {
  double of_all = 0;
  double between_objects = 0;  // without what an object has to itself
};
SmallestGaps smallest_gaps(const ContactSurface& surface, const PairTable& pairs,
                           const Candidates& candidates, const VecX& x);

}  // namespace tack
