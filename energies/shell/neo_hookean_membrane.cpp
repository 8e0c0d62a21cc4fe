// Compressible neo-Hookean membrane in plane stress: the density of the solid,
//     psi = mu/2 (s1^2 + s2^2 + s3^2 - 3) - mu ln J + lambda/2 (ln J)^2,   J = s1 s2 s3,
// minimised over the stretch s3 across the sheet: mu (s3^2 - 1) + lambda ln J = 0, no stress across the sheet.
// The membrane resists compression to a line. Derivatives are those of the density with s3 condensed.
#include <limits>

#include "energies/shell/membrane.hpp"

namespace tack {

struct NeoHookeanMembrane {
  double mu, lambda;

  NeoHookeanMembrane(double young, double poisson)
      : mu(young / (2 * (1 + poisson))), lambda(young * poisson / ((1 + poisson) * (1 - 2 * poisson))) {}

  // e = s3^2 - 1 for ln(s1 s2) and (s1 s2)^2. The condition mu e + lambda (ln(1 + e) / 2 + ln(s1 s2)) = 0 is concave and rises in
  // e: Newton's method from below stays below. Below are the solution with e for ln(1 + e), 1/(s1 s2)^2 - 1 where the area
  // grows, and 0 where it shrinks.
  Pack across(const Pack& log_area, const Pack& square) const {
    constexpr int most = 40;
    const Pack lowest = select(log_area > 0, 1 / square - 1, 0);
    const Pack guess = -2 * lambda / (lambda + 2 * mu) * log_area;
    Pack e = select(guess > lowest, guess, lowest);
    for (int i = 0; i < most; ++i) {
      const Pack rest = mu * e + lambda * (log1p(e) / 2 + log_area);
      const Pack change = rest / (mu + lambda / 2 / (1 + e));
      e -= change;
      // After a change below the square root of round-off, the next change is below round-off.
      if (!any(abs(change) > 1e-9 * (1 + e))) break;
    }
    return e;
  }

  // Green's strain avoids first-order terms that cancel near the rest shape only in exact arithmetic.
  Pack energy(const PlaneStrain& e, const PackMat32&) const {
    const Pack growth = 2 * e.trace + 4 * e.det;  // (s1 s2)^2 - 1
    const PackMask flat = growth <= -1;
    const Pack safe = select(flat, 0, growth), log_area = log1p(safe) / 2;
    const Pack thick = across(log_area, 1 + safe), log_j = log_area + log1p(thick) / 2;
    const Pack psi = mu / 2 * ((safe - 2 * log_area) - 4 * e.det + (thick - log1p(thick))) + lambda / 2 * log_j * log_j;
    return select(flat, std::numeric_limits<double>::infinity(), psi);
  }

  PlaneDerivatives derivatives(const PackVec2& s) const {
    const Pack area = s.prod(), log_area = log(area);
    const Pack z = 1 + across(log_area, area * area);
    const Pack pressure = -mu * z;  // lambda ln J - mu, where there is no stress across
    // Derivatives of psi(s1, s2, ln s3), y = ln s3: d2/dy2 = 2 mu z + lambda, d2/ds_i dy = lambda / s_i.
    const Pack condensed = lambda - lambda * lambda / (2 * mu * z + lambda);
    PlaneDerivatives d;
    PackVec2 inverse;
    for (int i = 0; i < 2; ++i) {
      inverse(i) = 1 / s(i);
      d.gradient(i) = mu * s(i) + pressure * inverse(i);
      d.hessian(i, i) = mu + (condensed - pressure) * inverse(i) * inverse(i);
    }
    d.hessian(0, 1) = d.hessian(1, 0) = condensed * inverse(0) * inverse(1);
    return d;
  }
};

using NeoHookeanMembraneEnergy = Membrane<NeoHookeanMembrane>;
TACK_REGISTER(Energy, NeoHookeanMembraneEnergy, "neo_hookean_membrane",
              "Neo-Hookean membrane in plane stress, for large stretches; its area does not vanish.",
              "Bonet and Wood, Nonlinear Continuum Mechanics for Finite Element Analysis, 6.4.3 and 6.6.2");

}  // namespace tack
