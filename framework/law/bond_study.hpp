// Study of a bond law alone: parting along the normal, tangentially and between, slowly and at
// speed, with unloading and reloading; the time of pressing that full strength needs; key numbers.
#pragma once

#include "framework/bond/bond_curve.hpp"
#include "framework/law/studied_law.hpp"

namespace tack {

struct BondPath {
  std::string name;  // "slow", "unloading", "rate"
  double angle = 0;  // to the normal [rad]
  double speed = 0;  // m/s; 0: slowly
  double shown = 0;  // opening beyond which there is little to see [m]
  std::vector<BondPoint> points;
};

// Returns the largest traction of slow parting after a time of pressing.
struct HealingCurve {
  double pressure;                                 // Pa
  std::vector<std::pair<double, double>> strength;  // over time [s, Pa]
};

struct BondStudy {
  std::vector<BondPath> slow, unloading, rates;  // of directions in which it holds
  std::vector<HealingCurve> healing;             // empty: it does not
  std::vector<LawFigure> figures;
};

// Along the way, and its traction in that direction.
double way_of(const BondPoint& p);
double pull_of(const BondPoint& p, double angle);

std::string direction_name(double angle);  // "along the normal", "at 45°", "across"

BondStudy study_bond_law(const StudiedLaw& studied, const StudySettings& settings);

}  // namespace tack
