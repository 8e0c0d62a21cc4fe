// Contact points with rotations (contact_spins.hpp). Beside coefficients c of vector dofs
// (vertices) they have directions b of scalar dofs z, and move by
//     sum_i c_i (x_i - x_i^n) + sum_j b_j (z_j - z_j^n).
// Points with equal numbers of dofs form a group, which is one batch.
#pragma once

#include "framework/contact/points/contact_points.hpp"
#include "framework/contact/points/contact_spins.hpp"
#include "framework/core/term.hpp"

namespace tack {

struct RollingPoint {
  std::array<int, largest_arity> vertices;                       // vector dofs, then scalar dofs
  std::array<double, largest_contact_arity> coefficients;        // c
  std::array<Vec3, ContactSpins::Columns::capacity> directions;  // b
  int vector_count, scalar_count;
  int own_vertex_count;  // of the point; those of the opposite feature follow
  Vec3 normal;           // unit, from the closest point to the point
  TangentBasis tangents;
  double gap;           // distance, offsets included [m]
  double area;          // m^2
  double normal_force;  // N
  int object, opposite;
  int law;

  int arity() const { return vector_count + scalar_count; }
  bool between(int a, int b) const {
    return (object == a && opposite == b) || (object == b && opposite == a);
  }
  Vec3 moved(const VecX& x, const VecX& start) const;  // m
  // Returns the derivative by dof i of a function with this slope by the moved point.
  Vec3 slope_of(int i, const Vec3& slope) const;
  // Writes the Hessian slot (term.hpp) of a function with this curvature by the moved point.
  void fill_hessian(const Mat3& curvature, double* slot) const;
};

struct RollingGroup {
  int vector_count, scalar_count;
  std::vector<RollingPoint> points;
  std::vector<int> vertices;  // of all points, in the order of a batch

  StencilBatch batch() const {
    return {vector_count + scalar_count, static_cast<int>(points.size()), vertices.data(),
            scalar_count};
  }
};

// Contact points on which friction acts at one configuration.
struct FrictionPoints {
  ContactPoints sliding;              // at which nothing turns
  std::vector<RollingGroup> rolling;  // ascending by (vector_count, scalar_count)
};

// Splits contact points into those without and with rotations. x: positions for the tangents of
// rods (3n) [m].
FrictionPoints split_by_spin(const ContactPoints& points, const ContactSpins& spins, const VecX& x);

}  // namespace tack
