#include "solvers/lcp/gauss_seidel.hpp"

#include <algorithm>
#include <cmath>

namespace tack {
namespace {

// Sweeps of a block per update of other blocks; an update costs a solve.
constexpr int inner_sweeps = 4;

}  // namespace

void GaussSeidel::add(RowUnit unit, const Vec3& impulse) {
  impulses_.conservativeResize(unit.end());
  change_.conservativeResize(unit.end());
  impulses_.segment(unit.first, unit.rows) = impulse.head(unit.rows);
  change_.segment(unit.first, unit.rows).setZero();
  ends_.push_back(unit.end());
  units_.push_back(std::move(unit));
}

// Extends the operator by the new rows, and adds the effect of their initial impulses.
void GaussSeidel::extend() {
  delassus_.extend(ends_);
  made_ = delassus_.velocities(impulses_, 0, rows_.count());
  for (int row = 0; row < rows_.count(); ++row) change_[row] = rows_.times(row, made_);
}

bool GaussSeidel::solve(int sweeps, double tolerance, PhaseClock& clock) {
  extend();
  const auto& blocks = delassus_.blocks();
  const bool alone = blocks.size() <= 1;
  bool converged = units_.empty();
  for (int done = 0; !converged && done < sweeps; ++done) {
    clock.deadline().check();
    double largest = 0;
    int unit = 0;
    for (const Delassus::Block& block : blocks) {
      if (alone) {
        largest = sweep(block, unit);
        continue;
      }
      for (int row = block.first; row < block.end(); ++row) change_[row] = rows_.times(row, made_);
      const VecX before = impulses_.segment(block.first, block.rows());
      const int first_unit = unit;
      for (int inner = 0; inner < inner_sweeps; ++inner) {
        unit = first_unit;
        const double change = sweep(block, unit);
        if (inner == 0) largest = std::max(largest, change);
        if (change < tolerance) break;
      }
      VecX changed = VecX::Zero(rows_.count());
      changed.segment(block.first, block.rows()) = impulses_.segment(block.first, block.rows()) - before;
      if (!changed.isZero(0)) made_ += delassus_.velocities(changed, block.first, block.end());
    }
    ++sweeps_;
    converged = largest < tolerance;
  }
  made_ = delassus_.velocities(impulses_, 0, rows_.count());
  for (int row = 0; row < rows_.count(); ++row) change_[row] = rows_.times(row, made_);
  return converged;
}

// Returns the impulses of a unit that fulfil its constraints if nothing else changes. w: diagonal
// of W.
Vec3 GaussSeidel::wanted(const RowUnit& unit, const Vec3& w) const {
  const double h = step_.h();
  const Vec3 old = at(unit, impulses_), u = velocity(unit);
  Vec3 now = Vec3::Zero();
  if (unit.bond >= 0) {
    const BondStiffness k = stiffness_(unit, unit.start + h * u);
    const auto soft = [&](int i, double stiffness) {
      if (!(stiffness > 0)) return 0.0;
      const double compliance = 1 / (h * h * stiffness);
      return old[i] - (u[i] + unit.start[i] / h + compliance * old[i]) / (w[i] + compliance);
    };
    now[0] = soft(0, k.along);
    if (!unit.resists_compression) now[0] = std::min(0.0, now[0]);
    for (int i = 1; i < unit.rows; ++i) now[i] = soft(i, k.across);
    return now;
  }
  now[0] = std::max(0.0, old[0] - (u[0] + unit.start[0] / h) / w[0]);
  if (unit.rows == 1) return now;
  const double most = unit.mu * now[0], across = std::max(w[1], w[2]);
  Vec2 along = old.tail<2>();
  if (across > 0) along -= u.tail<2>() / across;
  if (const double size = along.norm(); size > most) along *= most / size;
  now.tail<2>() = along;
  return now;
}

// Sweeps over the units of a block. Returns the largest change of a velocity [m/s].
double GaussSeidel::sweep(const Delassus::Block& block, int& unit) {
  double largest = 0;
  for (; unit < static_cast<int>(units_.size()) && units_[unit].end() <= block.end(); ++unit) {
    const RowUnit& of = units_[unit];
    Vec3 w = Vec3::Zero();
    for (int i = 0; i < of.rows; ++i) w[i] = block.w(of.first - block.first + i, of.first - block.first + i);
    if (!(w[0] > 0)) continue;  // no dof can move
    // The tangential rows use the updated normal impulse.
    for (int part = 0; part < (of.rows > 1 ? 2 : 1); ++part) {
      const Vec3 now = wanted(of, w);
      const int from = part == 0 ? 0 : 1, to = part == 0 ? 1 : 3;
      for (int i = from; i < to; ++i) {
        const int row = of.first + i;
        const double change = now[i] - impulses_[row];
        if (change == 0) continue;
        impulses_[row] = now[i];
        change_.segment(block.first, block.rows()) += change * block.w.col(row - block.first);
        largest = std::max(largest, std::abs(change) * w[i]);
      }
    }
  }
  return largest;
}

double GaussSeidel::residual() const {
  double largest = 0;
  size_t unit = 0;
  for (const Delassus::Block& block : delassus_.blocks())
    for (; unit < units_.size() && units_[unit].end() <= block.end(); ++unit) {
      const RowUnit& of = units_[unit];
      Vec3 w = Vec3::Zero();
      for (int i = 0; i < of.rows; ++i) w[i] = block.w(of.first - block.first + i, of.first - block.first + i);
      if (w[0] > 0) largest = std::max(largest, (wanted(of, w) - at(of, impulses_)).cwiseProduct(w).cwiseAbs().maxCoeff());
    }
  return largest;
}

}  // namespace tack
