// A bond law by itself: what a bond does on a way that is prescribed, step by step.
#pragma once

#include <vector>

#include "framework/bond/bond_law.hpp"

namespace tack {

struct BondPoint {
  double time = 0;               // s
  double opening = 0, slip = 0;  // m
  double traction = 0, shear = 0;  // along the normal and along the slip [Pa]
  double intensity = 1;
  double stored = 0;      // J/m^2
  double dissipated = 0;  // since the beginning [J/m^2]
};

// A point of a way: there at that time, under that pressure of a barrier.
struct BondStep {
  double time, opening, slip, pressure = 0;  // s, m, m, Pa
};

// The states at the ends of the steps of a new bond, which has gone from where it does no more.
std::vector<BondPoint> follow_bond(const BondLaw& law, const std::vector<BondStep>& way, bool on_contact = false);

// Pulled straight to each of the turns in turn, from where it was made (m; along the normal with angle 0, across with pi/2 or between
// [rad]), in about so many equal steps. At a speed [m/s]; with 0 so slowly that viscosity resists next to nothing. A law that is integrated
// gets as many steps between as it needs.
std::vector<BondPoint> pull_bond(const BondLaw& law, const std::vector<double>& turns, double angle, int points, double speed = 0);

// Parted slowly in that direction, until next to nothing holds any more. Empty if nothing ever does.
std::vector<BondPoint> part_slowly(const BondLaw& law, double angle = 0, int points = 2000);

}  // namespace tack
