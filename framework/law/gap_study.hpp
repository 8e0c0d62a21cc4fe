// Study of a traction-separation law alone: its curve, with and without barrier; key numbers.
#pragma once

#include "framework/law/studied_law.hpp"

namespace tack {

struct GapPoint {
  double gap;                      // m
  double traction, energy;         // of the law [Pa, J/m^2]
  double pair_traction, pair_energy;  // of the law and the barrier
};

struct GapStudy {
  std::vector<GapPoint> curve;  // to beyond its range
  double shown = 0;             // gap beyond which there is little to see [m]
  std::vector<LawFigure> figures;
};

GapStudy study_gap_law(const StudiedLaw& studied, const StudySettings& settings);

}  // namespace tack
