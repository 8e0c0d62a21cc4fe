// Problems over sets of blocks for methods that treat blocks of unknowns in turn
// (MinimizerProblem::locals). Where a problem offers none, those made here evaluate the whole
// objective and take the rows of their blocks out of it.
#pragma once

#include <vector>

#include "framework/core/minimizer.hpp"

namespace tack {

/// Returns problems over sets of blocks (each ascending), beginning at q, to be solved in turn: see
/// MinimizerProblem::locals. q must outlive them; whole evaluations read and write it.
std::vector<LocalProblem> local_problems(const MinimizerProblem& problem,
                                         const std::vector<std::vector<int>>& sets, VecX& q);

}  // namespace tack
