// Maxwell branch of a viscoelastic solid: a spring and a dashpot in series, beside a hyperelastic
// energy of the same tets. Several branches are a generalised Maxwell model (Prony series).
//
// The deformation F = F_e F_v has an elastic and a viscous part, e = ln s(F_e) is the elastic
// Hencky strain. The spring stores
//     psi(F_e) = mu |dev e|^2 + K/2 (tr e)^2 ,
// and the dashpot lets e decay at a fixed F: de/dt = -e / time (dev e alone if K = 0). With
// x = h / time, a step h decays at its start x_n, moves without flow, and decays at its end:
//     e' = b e_n,   e_tr = ln s(F F_v'^-1),   e_(n+1) = a e_tr,
//     a = (1 - exp(-x)) / x,   b = exp(-x) / a .
// The stress at the end, 2 mu a dev e_tr + K a tr e_tr, is the derivative of the potential a psi,
// isotropic in F F_v'^-1: a step stays a minimisation. For coaxial motions e_(n+1) =
// exp(-x) e_n + a (change of strain), the recurrence of Taylor, Pister and Goudreau 1970: exact at
// a constant rate of strain in the step, however long, and of second order otherwise. (Simo 1987
// has exp(-x/2) for a, which loses the dashpot in steps longer than `time`.) Dissipation: that of
// this constant rate. Sources: Taylor, Pister, Goudreau 1970, Thermomechanical analysis of
// viscoelastic solids; Simo 1987, On a fully three-dimensional finite-strain viscoelastic damage
// model; Reese and Govindjee 1998, A theory of finite viscoelasticity (the split of F).
#pragma once

#include "energies/solid/stvk_hencky.hpp"
#include "energies/viscoelastic/relaxation.hpp"
#include "framework/bond/temperature_shift.hpp"

namespace tack {

struct Maxwell : StvkHencky {
  // A split without volume: the branch has none, or linear tets (maxwell_branch.cpp).
  auto split() const { return MaterialSplit<Maxwell, Maxwell, LogVolume>{*this, *this, {0}}; }
};

struct MaxwellParameters {
  double modulus = 1e4;  // shear modulus mu of the spring [Pa]
  double bulk = 0;       // its bulk modulus K [Pa]
  double time = 1;       // relaxation time at constant strain [s]
  TemperatureShift shift = {};

  double lambda() const { return bulk - 2 * modulus / 3; }
  Relaxation<3> relaxation() const { return {modulus, lambda(), time, bulk == 0}; }
  /// The potential a psi.
  Maxwell potential(double a) const { return {{{a * modulus, a * lambda()}}}; }
};

}  // namespace tack
