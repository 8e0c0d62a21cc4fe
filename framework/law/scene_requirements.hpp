// Requirements of an adhesion law on a scene.
#pragma once

#include "framework/law/studied_law.hpp"

namespace tack {

// Openings between which the traction falls from 0.9 to 0.1 of its largest value [m].
struct SofteningRange {
  double from = 0, to = 0;
  double width() const { return to - from; }
};

// Returns the softening range of a traction; both openings are 0 if it never falls that far.
// traction: pairs of opening [m] and traction [Pa], openings ascending.
SofteningRange softening_range(const std::vector<std::pair<double, double>>& traction);

// Appends the process zone of solids and the bending length of sheets and rods, which set the mesh
// size, and the displacement of surfaces per step, which sets the step size. softening: under slow
// loading. at_speed: at the speed of the settings; empty if unknown.
void add_scene_requirements(const StudiedLaw& studied, const StudySettings& settings,
                            const SofteningRange& softening, const SofteningRange& at_speed,
                            std::vector<KeyQuantity>& quantities);

}  // namespace tack
