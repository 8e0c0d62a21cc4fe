// Projected Gauss-Seidel sweeps over contacts and bonds (Otaduy et al. 2009, Gascon et al. 2010).
// With the velocities u = u* + W lambda along rows:
//     contact  0 <= lambda_n, u_n + g/h >= 0, one of them 0;
//              |lambda_t| <= mu lambda_n, against the slip (cone)
//     bond     a_n = -h k_n <d + h u_n>  (without <> for bonds that resist compression),
//              a_t = -h k_t (s + h u_t):  rows of compliance 1/(h^2 k)
// g: gap at the start of the step less the gap that is kept; d, s: opening and slip of the bond at
// the start; k: stiffness of the law at the end of the step.
#pragma once

#include <functional>
#include <vector>

#include "solvers/lcp/delassus.hpp"

namespace tack {

// A unit of one row (normal) or three rows (normal, then two tangents).
struct RowUnit {
  int first = 0, rows = 1;
  int contact = -1, bond = -1;  // index of the contact or of the bond; -1: not one
  Vec3 free = Vec3::Zero();     // u* [m/s]
  Vec3 start = Vec3::Zero();    // g, or d and s [m]
  double mu = 0;
  bool resists_compression = false;  // of bonds

  int end() const { return first + rows; }
};

struct BondStiffness {
  double along, across;  // N/m
};

class GaussSeidel {
 public:
  // Returns the stiffness of a bond. at: opening and slip along the unit's rows [m].
  using Stiffness = std::function<BondStiffness(const RowUnit& bond, const Vec3& at)>;
  GaussSeidel(LinearizedStep& step, const Rows& rows, int most, Stiffness stiffness)
      : step_(step), rows_(rows), delassus_(step, rows, most), stiffness_(std::move(stiffness)) {}

  // Adds a unit with its initial impulse [N s]. Its rows must exist.
  void add(RowUnit unit, const Vec3& impulse);
  // Sweeps until no velocity changes by more than `tolerance` [m/s]. Returns false after `sweeps`
  // sweeps without convergence.
  bool solve(int sweeps, double tolerance, PhaseClock& clock);

  const std::vector<RowUnit>& units() const { return units_; }
  Vec3 impulse(const RowUnit& unit) const { return at(unit, impulses_); }
  Vec3 velocity(const RowUnit& unit) const { return unit.free + at(unit, change_); }
  // Velocities of the unknowns due to all impulses [m/s].
  const VecX& made() const { return made_; }
  // Largest violation of the constraints, |min(u_n + g/h, W lambda)| for a contact [m/s].
  double residual() const;
  int sweeps() const { return sweeps_; }
  int row_count() const { return rows_.count(); }
  long solves() const { return delassus_.solves(); }

 private:
  static Vec3 at(const RowUnit& unit, const VecX& values) {
    return unit.rows == 1 ? Vec3(values[unit.first], 0, 0) : Vec3(values.segment<3>(unit.first));
  }
  Vec3 wanted(const RowUnit& unit, const Vec3& w) const;
  double sweep(const Delassus::Block& block, int& unit);
  void extend();

  LinearizedStep& step_;
  const Rows& rows_;
  Delassus delassus_;
  Stiffness stiffness_;
  std::vector<RowUnit> units_;
  std::vector<int> ends_;
  VecX impulses_, change_;  // lambda, and u - u*
  VecX made_;
  int sweeps_ = 0;
};

}  // namespace tack
