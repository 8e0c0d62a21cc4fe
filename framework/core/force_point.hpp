// Points between two surfaces at which the force of a term acts: its quadrature points.
#pragma once

#include <functional>
#include <span>
#include <string_view>

#include "geometry/types.hpp"

namespace tack {

/// A point of one surface, the closest point of the opposite one, and the force between both:
///     sum_i c_i x_i = gap n,    sum over the point's vertices of c_i = 1
/// with the coefficients c of the point and, negative, of the closest point. Bonds may have
/// slipped: their gap is along the normal alone.
struct ForcePoint {
  int object = -1, opposite = -1;        // indices of both objects; equal in self-contact
  std::span<const int> vertices;         // global: of the point, then of the opposite primitive
  std::span<const double> coefficients;  // c
  int own_vertex_count = 1;              // vertices of the point
  Vec3 normal = Vec3::Zero();            // n, unit, from the closest point to the point
  double gap = 0;                        // distance, offsets included [m]
  double area = 0;                       // quadrature weight [m^2]; negative by inclusion-exclusion
  double normal_force = 0;  // that presses the two together at the point [N]; negative if it pulls
  Vec3 force = Vec3::Zero();  // on the object of the point [N]; the opposite one has minus it

  /// Returns the point at the positions x (3n) [m].
  Vec3 point(const VecX& x) const { return sum(x, 0, own_vertex_count); }
  /// Returns the closest point at the positions x (3n) [m].
  Vec3 opposite_point(const VecX& x) const {
    return -sum(x, own_vertex_count, static_cast<int>(vertices.size()));
  }

 private:
  Vec3 sum(const VecX& x, int first, int last) const {
    Vec3 at = Vec3::Zero();
    for (int i = first; i < last; ++i) at += coefficients[i] * vertex(x, vertices[i]);
    return at;
  }
};

using ForcePointVisitor = std::function<void(const ForcePoint& point)>;

/// Interface of terms whose force acts at points between two surfaces. The forces of all points add
/// up to the force of the term between objects.
class ForcePoints {
 public:
  /// Calls visit for each point at the configuration x (3n) [m] of the contact system. summand: as
  /// of the term's force record; "": the whole force.
  virtual void visit_points(const VecX& x, std::string_view summand,
                            const ForcePointVisitor& visit) const = 0;

 protected:
  ~ForcePoints() = default;
};

}  // namespace tack
