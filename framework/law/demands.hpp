// What a law of adhesion asks of a scene.
#pragma once

#include "framework/law/studied_law.hpp"

namespace tack {

// The way over which it lets go: from nine tenths of the largest traction to a tenth [m].
struct Fall {
  double from = 0, to = 0;
  double way() const { return to - from; }
};

// Of a traction by opening, ascending; both 0 of what never falls so far.
Fall fall_of(const std::vector<std::pair<double, double>>& traction);

// The process zone (Hillerborg et al. 1976), and by it the mesh; the way of surfaces in a step, and by it the step.
void add_demands(const StudiedLaw& studied, const StudySettings& settings, const Fall& fall, std::vector<LawFigure>& figures);

}  // namespace tack
