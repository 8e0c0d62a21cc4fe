// Study of a traction-separation law without a scene: its curve, with and without barrier, and its
// key quantities.
#pragma once

#include "framework/law/studied_law.hpp"

namespace tack {

struct GapPoint {
  double gap;                         // m
  double traction, energy;            // of the law [Pa, J/m^2]
  double pair_traction, pair_energy;  // of the law and the barrier
};

struct GapStudy {
  std::vector<GapPoint> curve;  // up to 1.02 times the range
  double shown = 0;             // largest gap in plots [m]
  std::vector<KeyQuantity> quantities;
};

GapStudy study_gap_law(const StudiedLaw& studied, const StudySettings& settings);

}  // namespace tack
