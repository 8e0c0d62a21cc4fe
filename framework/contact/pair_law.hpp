// The sum of the normal laws of one pair of materials: barrier + adhesion, one scalar law per pair,
// differentiated once and made positive semi-definite once (method: sum before projecting).
#pragma once

#include <memory>
#include <vector>

#include "framework/contact/normal_law.hpp"

namespace tack {

//
// The laws are functions of the gap between the surfaces as they are: the distance d of what is meshed, less the part of it
// that is filled by the thickness of the two sides, the offset. All arguments and ranges here are distances.
class PairLaw {
 public:
  explicit PairLaw(double offset = 0) : offset_(offset) {}

  double offset() const { return offset_; }  // m
  void add(std::shared_ptr<const NormalLaw> law) { laws_.push_back(std::move(law)); }
  double range() const;
  void samples(int n, const double* d, LawSample* out) const;  // overwrites
  void values(int n, const double* d, double* out) const;      // overwrites
  LawSample at(double d) const;

  // The effective work of adhesion - min_d phi(d) [J/m^2] (0 if the law only repels), found
  // numerically, and the gap (without offset) at that minimum, where two free surfaces come to rest.
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
