// Contact points: what touches, adheres or rubs, each once and by name, whatever stencils it takes
// to say so.
//
// A contact point is a point of one surface and what it faces of an object, at one configuration.
// The point is a vertex, a sample (inside a triangle, surface_overlap.hpp) or, of a pair of edges,
// one on the first edge; it has
//     sum_i c_i x_i = gap n,    sum_i c_i = 0
// with the coefficients c of the point and, negative, of the closest point on what it faces, the
// unit normal n from there to the point, a basis of the plane across it, and the magnitudes
//     area         = sum w            [m^2]
//     normal force = - sum w b'(d)    of the laws b that press; the barrier's alone for friction,
//     as adhesion does not press [N].
//
// Inclusion-exclusion (point_features.hpp) gives a point several features with weights of both
// signs. Friction of each by itself would not be convex, and its magnitudes would not add up. So
// the features of one (point, object, law) whose normals agree (dot > 0) are one contact point:
// force is the net one along the normal of the strongest feature, area the net weight, neither
// below zero, and normal, gap and closest point are the strongest feature's. A vertex between two
// walls is two of them, and so is one that presses as well as guards: those have laws of their own.
// Pairs of edges are one each.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "framework/contact/by_arity.hpp"
#include "framework/contact/contact_system.hpp"

namespace tack {

using TangentBasis = Eigen::Matrix<double, 3, 2>;

enum class PointKind { vertex, sample, edges };

template <int K>
struct ContactPoint {
  std::array<int, K> vertices;         // global: the point's, then those of what it faces
  std::array<double, K> coefficients;  // c
  Vec3 normal;                         // n
  TangentBasis tangents;
  double gap;           // distance, whatever offset the law takes off [m]
  double area;          // m^2
  double normal_force;  // N
  // How many of the vertices are the point's: 1 of a vertex, 3 of a sample, 2 of an edge.
  int own;
  // The vertex, or the number of the sample in this step; -1 of a pair of edges.
  int point;
  int object;           // whose point it is
  int opposite;         // the object that it faces; its own in self-contact
  int law;              // of the pair table

  PointKind kind() const {
    return own == 1 ? PointKind::vertex : own == 3 ? PointKind::sample : PointKind::edges;
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

// By arity; those of vertices and samples by (point, object, law), then pairs of edges.
using ContactPoints = ByArity<ContactPoint>;

struct ContactPointsRequest {
  const ContactSystem& system;           // must be at x
  const std::vector<PairLaw>& pressing;  // what presses of each law of its pair table
  const std::vector<char>& wanted;       // per law: points of others are left out if 0
  const VecX& x;
};
ContactPoints contact_points(const ContactPointsRequest& request);

// Returns, per law of a table, whether it acts over an area, in any pair or between two objects;
// laws of safety barriers do not.
std::vector<char> laws_of_area(const PairTable& pairs);
std::vector<char> laws_of_area(const PairTable& pairs, int a, int b);

// Its parts: a basis of the plane across a unit normal, and vertices and samples
// (contact_points_of_features.cpp).
TangentBasis tangents_of(const Vec3& normal);
void add_points_of_features(const ContactPointsRequest& request, ContactPoints& out);

}  // namespace tack
