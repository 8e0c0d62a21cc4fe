// Which points are evaluated, and which is the best.
//
// Points that fill the ranges evenly, the guess before them (design); from each of the best of them a search by quadratic models (chain; BOBYQA, Powell
// 2009, by NLopt) that ends early. From the best end of all, where runs give their own derivatives and these tell what the points around there are like,
// Levenberg-Marquardt steps (polish; by Ceres); else a chain that goes on to the tolerance, and such steps with derivatives by central differences. A point
// that failed is as bad as the worst before it. Local methods alone find the answer half as often: curves that break off at once have misfits with steps and
// many minima.
//
// Every search is a sequence of its own, so that the points do not depend on which run was done first.
#pragma once

#include <functional>

#include "framework/calibrate/derivatives.hpp"
#include "framework/calibrate/point_queue.hpp"

namespace tack {

struct SearchRow {
  std::string phase;  // "design", "chain 1", "final chain", "polish", "derivatives"
  PointEvaluation evaluation;
};

struct SearchResult {
  std::vector<SearchRow> rows;  // each point once, where it was first asked for, and once more where derivatives were
  PointEvaluation best;
  Derivatives derivatives;  // at the best point
};

// `tell`: the phase that begins, and its number of points (0: not known); the best so far.
using SearchProgress = std::function<void(const std::string& phase, int points, const PointEvaluation* best)>;

// `noise_known`: residuals are in units of it. Throws SimulationError if not one point of the design could be evaluated, Interrupted.
SearchResult search_for(const std::vector<FittedNumber>& numbers, const SearchConfig& config, Evaluator& evaluator, const SearchProgress& tell,
                        bool noise_known = true);

}  // namespace tack
