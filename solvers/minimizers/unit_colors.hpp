// Colours of units of motion: no two units of a colour are coupled by the Hessian that they were
// coloured for. A unit has one to four blocks of three unknowns (a vertex, an affine body); units
// with more are taken block by block. Greedy in the order of the units, so that the colours depend
// on nothing else.
#pragma once

#include <vector>

#include "framework/core/minimizer.hpp"

namespace tack {

class UnitColors {
 public:
  UnitColors(const MinimizerProblem& problem, const BlockMatrix& hessian);

  std::vector<std::vector<int>> sets;  // blocks of each colour, ascending

  /// Returns p, H_uu p_u = -g_u for each unit u of a colour. hessian, gradient: over the blocks of
  /// the colour. Not finite where H_uu is not.
  VecX newton_steps(size_t color, const BlockMatrix& hessian, const VecX& gradient) const;
  /// Halves p of the units of a colour along which the objective rises at the end of their step,
  /// gradient . p > 0; of all if there are none.
  void halve_overshooting(size_t color, const VecX& gradient, VecX& p) const;
  /// Writes the unknowns of a colour into those of all.
  void scatter(size_t color, const VecX& own, VecX& all) const;

 private:
  // Units as lists of positions of their blocks in the set, and by position the unit and the place
  // in it.
  struct Color {
    std::vector<std::vector<int>> units;
    std::vector<int> unit_of, place_in_unit;
  };
  std::vector<Color> colors_;
};

}  // namespace tack
