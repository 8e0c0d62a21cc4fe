// Interface of line searches, which choose the step length along a descent direction.
#pragma once

#include <limits>

#include "framework/config/registry.hpp"
#include "framework/core/objective.hpp"

namespace tack {

/// Result of a search: the step length [1], if one was found, and the evaluations of the objective.
struct LineSearchResult {
  bool found = false;
  double step = 0;
  int evaluations = 0;
};

/// Interface of line searches.
class LineSearch : public Component {
 public:
  static constexpr const char* kind_name = "line_search";
  static constexpr const char* kind_doc = "Chooses the step length along a descent direction.";

  /// Searches from q, where the objective is, along p. slope: p . gradient(q) < 0. Every step in
  /// (0, t_max] is feasible. On success the objective is left at q + step p.
  virtual LineSearchResult search(Objective& objective, const VecX& q, const VecX& p, double slope,
                                  double t_max) = 0;
};

/// Armijo's condition for a step t, with a decrease above the rounding error of the values. start:
/// value at t = 0.
inline bool descends(double start, double value, double noise, double t, double slope,
                     double decrease) {
  return value < start - noise && value <= start + decrease * t * slope;
}

/// Returns the shortest step that changes a digit of q.
inline double smallest_step(const VecX& q, const VecX& p) {
  return std::numeric_limits<double>::epsilon() * q.lpNorm<Eigen::Infinity>() /
         p.lpNorm<Eigen::Infinity>();
}

}  // namespace tack
