// A law of bonds by itself: what a bond does when it is parted along the normal, across and between, slowly and at speed, unloaded on the
// way and loaded again; how long it has to be pressed for its strength; and its figures.
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

// The largest traction of what was pressed together for a time, when it is parted slowly.
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
