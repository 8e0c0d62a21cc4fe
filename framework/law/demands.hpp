// Requirements of an adhesion law on a scene.
#pragma once

#include "framework/law/studied_law.hpp"

namespace tack {

// Openings between which the traction falls from 0.9 to 0.1 of its largest value [m].
struct Fall {
  double from = 0, to = 0;
  double way() const { return to - from; }
};

// Returns the fall of a traction; both openings are 0 if it never falls that far. traction: pairs
// of opening and traction, openings ascending.
Fall fall_of(const std::vector<std::pair<double, double>>& traction);

// Appends the process zone (Hillerborg et al. 1976), which sets the mesh size, and displacement of
// surfaces per step, which sets the step size.
void add_demands(const StudiedLaw& studied, const StudySettings& settings, const Fall& fall,
                 std::vector<LawFigure>& figures);

}  // namespace tack
