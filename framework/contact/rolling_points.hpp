// Contact points at which something turns (contact_spins.hpp): beside coefficients of places they
// have directions of numbers, so that the point moves by
//     sum_i c_i (x_i - x_i^n) + sum_j b_j (z_j - z_j^n).
// Numbers of vertices differ from point to point; points of one kind stand together, as a batch.
#pragma once

#include "framework/contact/contact_points.hpp"
#include "framework/contact/contact_spins.hpp"
#include "framework/core/term.hpp"

namespace tack {

struct RollingPoint {
  std::array<int, largest_arity> vertices;                   // of places, then of numbers
  std::array<double, largest_contact_arity> coefficients;    // c
  std::array<Vec3, ContactSpins::Columns::capacity> directions;  // b
  int places, numbers;
  TangentBasis tangents;
  double area;          // m^2
  double normal_force;  // N
  int object, opposite;
  int law;

  int arity() const { return places + numbers; }
  bool between(int a, int b) const {
    return (object == a && opposite == b) || (object == b && opposite == a);
  }
  Vec3 moved(const VecX& x, const VecX& start) const;  // m
  // The derivative by vertex i of what has this slope by the moved point.
  Vec3 slope_of(int i, const Vec3& slope) const;
  // Writes the Hessian slot (term.hpp) of what has this curvature by the moved point.
  void fill_hessian(const Mat3& curvature, double* slot) const;
};

struct RollingGroup {
  int places, numbers;
  std::vector<RollingPoint> points;
  std::vector<int> vertices;  // of all points, as batches have them

  StencilBatch batch() const {
    return {places + numbers, static_cast<int>(points.size()), vertices.data(), numbers};
  }
};

// Contact points on which friction acts at one configuration.
struct FrictionPoints {
  ContactPoints sliding;              // at which nothing turns
  std::vector<RollingGroup> rolling;  // ascending by (places, numbers)
};

// x: of the tangents of rods (3n) [m].
FrictionPoints divided_by_spin(const ContactPoints& points, const ContactSpins& spins,
                               const VecX& x);

}  // namespace tack
