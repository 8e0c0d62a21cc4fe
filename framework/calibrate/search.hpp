// Which points are evaluated, and which is the best.
//
// Points that fill the ranges evenly, the guess before them (design); from each of the best of them a search by quadratic models (chain; BOBYQA, Powell
// 2009, by NLopt) that ends early, from the best end of all one that goes on to the tolerance; then Levenberg-Marquardt steps with derivatives by central
// differences (polish; by Ceres). A point that failed is as bad as the worst before it. Local methods alone find the answer half as often:
// curves that break off at once have misfits with steps and many minima.
//
// Every search is a sequence of its own, so that the points do not depend on which run was done first.
#pragma once

#include <functional>

#include "framework/calibrate/fitted_number.hpp"
#include "framework/calibrate/point_queue.hpp"
#include "geometry/types.hpp"

namespace tack {

struct SearchRow {
  std::string phase;  // "design", "chain 1", "final chain", "polish", "derivatives"
  PointEvaluation evaluation;
};

// d residuals / d u, at the best point.
struct Derivatives {
  Eigen::MatrixXd of_residuals;  // a row for each measured point, a column for each number
  std::string problem;           // why there are none; "" if there are
};

struct SearchResult {
  std::vector<SearchRow> rows;  // each point once, where it was first asked for
  PointEvaluation best;
  Derivatives derivatives;
};

// `tell`: the phase that begins, and its number of points (0: not known); the best so far.
using SearchProgress = std::function<void(const std::string& phase, int points, const PointEvaluation* best)>;

// Throws SimulationError if not one point of the design could be evaluated, Interrupted.
SearchResult search_for(const std::vector<FittedNumber>& numbers, const SearchConfig& config, Evaluator& evaluator, const SearchProgress& tell);

}  // namespace tack
