// Study of a bond law without a scene: opening along the normal, tangentially and at 45 degrees,
// quasi-static and at several speeds, with unloading and reloading; healing time; key quantities.
#pragma once

#include "framework/bond/bond_curve.hpp"
#include "framework/law/rate_scan.hpp"
#include "framework/law/studied_law.hpp"

namespace tack {

struct BondPath {
  std::string name;  // "slow", "unloading", "rate"
  double angle = 0;  // to the normal [rad]
  double speed = 0;  // m/s; 0: quasi-static
  double shown = 0;  // largest opening in plots [m]
  std::vector<BondPoint> points;
};

// Strength of bonds, the largest traction of quasi-static opening, over the time of pressing.
struct HealingCurve {
  double pressure;                                  // Pa
  std::vector<std::pair<double, double>> strength;  // over time [s, Pa]
};

struct BondStudy {
  std::vector<BondPath> slow, unloading;  // of directions with traction
  std::vector<BondPath> rates;            // three speeds, in the first of these directions
  RateScan scan;                          // in the first direction
  std::vector<HealingCurve> healing;      // empty: the law does not heal
  std::vector<KeyQuantity> quantities;
};

// Returns the length of opening and slip together [m].
double displacement_of(const BondPoint& p);
// Returns the traction along a direction [Pa]. angle: to the normal [rad].
double traction_along(const BondPoint& p, double angle);

std::string direction_name(double angle);  // "along the normal", "at 45°", "across"

BondStudy study_bond_law(const StudiedLaw& studied, const StudySettings& settings);

}  // namespace tack
