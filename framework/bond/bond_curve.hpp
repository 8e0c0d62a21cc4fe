// Response of a bond law alone: a bond on a prescribed path, step by step.
#pragma once

#include <vector>

#include "framework/bond/bond_law.hpp"

namespace tack {

/// State of a bond at a point of its path.
struct BondPoint {
  double time = 0;                 // s
  double opening = 0, slip = 0;    // m
  double traction = 0, shear = 0;  // along the normal and along the slip [Pa]
  double intensity = 1;
  double stored = 0;      // J/m^2
  double dissipated = 0;  // since the beginning [J/m^2]
};

/// A point of a path: opening and slip at a time, under a barrier pressure.
struct BondStep {
  double time, opening, slip, pressure = 0;  // s, m, m, Pa
};

/// Returns the states of a new bond at the ends of the steps; the path ends where the bond is gone.
std::vector<BondPoint> trace_bond(const BondLaw& law, const std::vector<BondStep>& path,
                                  bool on_contact = false);

/// Pulls a new bond straight to each of the turning points, in about `points` equal steps. turns:
/// distances from the site [m]; angle: 0 along the normal, pi/2 tangential [rad]; speed:
/// [m/s]; 0: so slow that viscosity does not resist. Laws that are integrated get substeps as
/// needed.
std::vector<BondPoint> pull_bond(const BondLaw& law, const std::vector<double>& turns, double angle,
                                 int points, double speed = 0);

/// Separates a bond slowly in that direction until hardly any traction is left. Empty if it never
/// fails.
std::vector<BondPoint> separate_slowly(const BondLaw& law, double angle = 0, int points = 2000);

}  // namespace tack
