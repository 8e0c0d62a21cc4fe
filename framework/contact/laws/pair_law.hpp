// Pair law: the sum of the normal laws of one pair of materials, barrier and adhesion. The sum is
// differentiated once and projected once to positive semi-definite Hessians.
#pragma once

#include <memory>
#include <vector>

#include "framework/contact/normal_law.hpp"

namespace tack {

// Terms of a pair law.
enum class LawTerm { all, barrier, adhesion };
// Returns the term of a record's name: "", "barrier" or "adhesion".
LawTerm law_term(std::string_view name);

// Laws are functions of the gap: the distance d of the meshed surfaces less the offset, the sum of
// the half thicknesses of both sides. Arguments and ranges of this class are distances.
class PairLaw {
 public:
  explicit PairLaw(double offset = 0) : offset_(offset) {}

  double offset() const { return offset_; }  // m
  void add(std::shared_ptr<const NormalLaw> law) { laws_.push_back(std::move(law)); }
  double range() const;
  double barrier_range() const;  // the largest of its barriers, as a gap [m]; 0 without any
  // Returns the sum of the laws of one term.
  PairLaw only(LawTerm term) const;
  // Returns the law between two points of one object that are `distance` apart at rest [m]. The
  // offset is reduced, and the range of the barrier ends at `distance` at the latest. Pressures are
  // those of the original law at equal fractions of the barrier range. Adhesion is not changed.
  PairLaw from_rest(double distance) const;
  // Returns the reduced offset of two points that are `distance` apart at rest [m].
  static double offset_from_rest(double offset, double distance);
  void samples(int n, const double* d, LawSample* out) const;  // overwrites
  void values(int n, const double* d, double* out) const;      // overwrites
  LawSample at(double d) const;

  // The well of the law, found numerically: the effective work of adhesion -min_d phi(d) [J/m^2] (0
  // if the law only repels), and the gap at the minimum [m], where two free surfaces are at rest.
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
