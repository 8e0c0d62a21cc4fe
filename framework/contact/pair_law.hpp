// The sum of the normal laws of one pair of materials: barrier + adhesion, one scalar law per pair,
// differentiated once and made positive semi-definite once (method: sum before projecting).
#pragma once

#include <memory>
#include <vector>

#include "framework/contact/normal_law.hpp"

namespace tack {

//
// The laws are functions of the gap between the surfaces as they are: the distance d of what is
// meshed, less the part of it that is filled by the thickness of the two sides, the offset. All
// arguments and ranges here are distances.
class PairLaw {
 public:
  explicit PairLaw(double offset = 0) : offset_(offset) {}

  double offset() const { return offset_; }  // m
  void add(std::shared_ptr<const NormalLaw> law) { laws_.push_back(std::move(law)); }
  double range() const;
  double barrier_range() const;  // of its largest barrier alone, as a gap [m]; 0 without any
  // Returns the law between two points of one object that are `distance` apart at rest [m]. The
  // offset is reduced, and the barrier begins at `distance` at the latest. Pressures are those of
  // the whole law at the same fraction of the barrier's range. Adhesion stays as it is.
  PairLaw from_rest(double distance) const;
  // Returns the offset that remains where two points are `distance` apart at rest [m].
  static double offset_from_rest(double offset, double distance);
  void samples(int n, const double* d, LawSample* out) const;  // overwrites
  void values(int n, const double* d, double* out) const;      // overwrites
  LawSample at(double d) const;

  // The effective work of adhesion - min_d phi(d) [J/m^2] (0 if the law only repels), found
  // numerically, and the gap (without offset) at that minimum, where two free surfaces come to
  // rest.
  struct Well {
    double depth = 0;
    double gap = 0;
  };
  Well well() const;

  const std::vector<std::shared_ptr<const NormalLaw>>& laws() const { return laws_; }

 private:
  void gap_samples(int n, const double* gap, LawSample* out) const;

  double offset_;
  std::vector<std::shared_ptr<const NormalLaw>> laws_;
};

}  // namespace tack
