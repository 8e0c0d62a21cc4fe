// Contact points: the positions at which surfaces touch, adhere or slide, each once, whatever the
// number of its stencils.
//
// A contact point is a point of one surface and the closest point of an object that it faces, at
// one configuration. The point is a vertex, an interior quadrature point (surface_overlap.hpp) or,
// of a pair of edges, a point of the first edge. It has
//     sum_i c_i x_i = gap n,    sum_i c_i = 0
// with the coefficients c of the point and, negative, of the closest point, the unit normal n from
// the closest point to the point, a basis of the plane orthogonal to n, and the magnitudes
//     area         = sum w            [m^2]
//     normal force = - sum w b'(d)    [N]
// where b are the barriers alone, as adhesion does not press.
//
// Inclusion-exclusion (point_features.hpp) gives a point several features with weights of both
// signs. Friction of single features would not be convex, and its magnitudes would not add up. The
// features of one (point, object, law) whose normals agree (dot > 0) are therefore one contact
// point. Its force is the net force along the normal of the strongest feature, its area the net
// weight, neither below zero; normal, gap and closest point are those of the strongest feature. A
// vertex between two walls is two contact points. A vertex that carries pressure and a safety
// barrier is two as well, because these have different laws. A pair of edges is one.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "framework/contact/stencils/by_arity.hpp"
#include "framework/contact/laws/pair_table.hpp"
#include "geometry/types.hpp"

namespace tack {

class ContactSystem;

using TangentBasis = Eigen::Matrix<double, 3, 2>;

enum class PointKind { vertex, interior, edges };

template <int K>
struct ContactPoint {
  std::array<int, K> vertices;         // global: of the point, then of the opposite feature
  std::array<double, K> coefficients;  // c
  Vec3 normal;                         // n
  TangentBasis tangents;
  double gap;           // distance, offsets included [m]
  double area;          // m^2
  double normal_force;  // N
  // Number of vertices of the point: 1 of a vertex, 3 of an interior point, 2 of an edge.
  int own_vertex_count;
  // The vertex, or the index of the interior point in this step; -1 of a pair of edges.
  int point;
  int object;    // of the point
  int opposite;  // the object that it faces; its own in self-contact
  int law;       // of the pair table
  // Elastic slip at the start of the step along both tangents [m]; of laws that stick
  // (stick_anchors.hpp).
  Vec2 elastic = Vec2::Zero();

  PointKind kind() const {
    return own_vertex_count == 1   ? PointKind::vertex
           : own_vertex_count == 3 ? PointKind::interior
                                   : PointKind::edges;
  }
  std::array<int, 2> objects() const {
    return {std::min(object, opposite), std::max(object, opposite)};
  }
  bool between(int a, int b) const {
    return (object == a && opposite == b) || (object == b && opposite == a);
  }
  // Returns the displacement of the point from start to x, relative to the opposite point [m].
  Vec3 moved(const VecX& x, const VecX& start) const {
    Vec3 sum = Vec3::Zero();
    for (int i = 0; i < K; ++i)
      sum += coefficients[i] * (vertex(x, vertices[i]) - vertex(start, vertices[i]));
    return sum;
  }
};

// Contact points by arity: of vertices, then of interior points, each sorted by (point, object,
// law), then pairs of edges.
using ContactPoints = ByArity<ContactPoint>;

struct ContactPointsRequest {
  const ContactSystem& system;
  const std::vector<char>& wanted;  // per law of its pair table: 0 leaves out its points
  const VecX& x;
};
// Returns the contact points of a system, as its contact model defines them. Throws logic_error if
// x is not its configuration; points of another one: ContactSystem::at.
ContactPoints contact_points(const ContactPointsRequest& request);
// Returns the contact points of the active stencils of a system.
ContactPoints points_of_stencils(const ContactPointsRequest& request);

// Returns, per law of a table, whether it is integrated over an area in any pair of objects, or
// between two objects. Laws of safety barriers are not.
std::vector<char> integrated_laws(const PairTable& pairs);
std::vector<char> integrated_laws(const PairTable& pairs, int a, int b);

// Returns a basis of the plane orthogonal to a unit normal.
TangentBasis tangents_of(const Vec3& normal);
// Appends the contact points of vertices and interior points (contact_points_of_features.cpp).
void add_points_of_features(const ContactPointsRequest& request, ContactPoints& out);

}  // namespace tack
