// Von Mises plasticity on a St. Venant-Kirchhoff solid in Hencky strain, for several tets side by
// side. F is the trial deformation F_tr = F Fp^-1, Fp that of the start of the step, e = ln s its
// Hencky strain, n = |dev e|, a the accumulated plastic strain. The yield surface is
// 2 mu n = sqrt(2/3) (sigma_y + H a), i.e. n = limit. Below it
//     psi = mu n^2 + K/2 (tr e)^2,
// and beyond it the deviatoric slope continues and rises by 2 mu' per strain,
//     psi = mu limit^2 + 2 mu limit r + mu' r^2 + K/2 (tr e)^2,
//     r = n - limit,   mu' = mu H / (3 mu + H).
// psi is the minimum of elastic energy and plastic work over all plastic flows,
//     mu (n - g)^2 + K/2 (tr e)^2 + w (sigma_y + H (a + w/2)),   w = sqrt(2/3) g,
// so that its stress is the return-mapped stress. The yield surface bounds Kirchhoff's stress.
// Viscosity eta (Perzyna 1966): sigma = sigma_y + H a + eta da/dt, with the dissipation potential
// eta (da/dt)^2 / 2. A step h adds eta w^2 / (2 h): H + eta/h replaces H in mu', not in the yield
// surface. Between steps, h = 0, nothing flows and psi is the stored energy.
// Sources: Li, Li, Jiang 2022, Energetically Consistent Inelasticity; Simo 1992 for the return
// mapping; Ortiz and Stainier 1999 for rates.
#pragma once

#include <Eigen/LU>

#include "energies/solid/isotropic_solid.hpp"

namespace tack {

struct VonMisesLanes {
  Lame lame;
  double hardened;  // mu' [Pa]
  Pack limit;       // largest elastic |dev e|

  Pack energy(const PackMat3& f) const {
    const Strain e = strain(svd3(f).s);
    const Pack inside = lame.mu * e.norm * e.norm;
    const Pack r = e.norm - limit;
    const Pack beyond = lame.mu * limit * (limit + 2 * r) + hardened * r * r;
    return select(f.determinant() > 0,
                  select(r > 0, beyond, inside) + bulk() / 2 * e.trace * e.trace, infinity);
  }

  PrincipalDerivatives derivatives(const PackVec3& s) const {
    const Strain e = strain(s);
    const PackMask yields = e.norm > limit;
    // tau = K tr e + c dev e, dtau/de = K + c (1 - 1/3) + w dev e dev e^T; c: secant stiffness, w:
    // its decrease.
    const Pack norm = select(yields, e.norm, 1);
    const Pack c =
        select(yields, 2 * (lame.mu * limit + hardened * (e.norm - limit)) / norm, 2 * lame.mu);
    const Pack w = select(yields, (2 * hardened - c) / (norm * norm), 0);
    const Pack pressure = bulk() * e.trace;
    PackVec3 tau;
    PackMat3 h;
    for (int i = 0; i < 3; ++i) {
      tau(i) = pressure + c * e.deviator(i);
      for (int k = 0; k < 3; ++k) h(i, k) = bulk() - c / 3 + w * e.deviator(i) * e.deviator(k);
    }
    return of_logarithms(s, tau, h, c);
  }

 private:
  struct Strain {
    Pack trace, norm;
    PackVec3 deviator;
  };
  static Strain strain(const PackVec3& s) {
    Strain e;
    for (int i = 0; i < 3; ++i) e.deviator(i) = log(s(i));
    e.trace = e.deviator.sum();
    for (int i = 0; i < 3; ++i) e.deviator(i) -= e.trace / 3;
    e.norm = sqrt(e.deviator.squaredNorm());
    return e;
  }
  double bulk() const { return lame.lambda + 2 * lame.mu / 3; }
};

// Material of a body whose tets have a yield surface each.
struct VonMises {
  Lame lame;
  double yield_stress;            // sigma_y [Pa]
  double hardening;               // H: yield stress per accumulated plastic strain [Pa]
  double viscosity = 0;           // eta [Pa s]
  std::vector<Pack> limits = {};  // of pack_width tets each
  double h = 0;                   // step size [s], with viscosity only

  VonMisesLanes at(int pack) const {
    return {lame, viscosity > 0 && h == 0 ? lame.mu : lame.mu * slope() / (3 * lame.mu + slope()),
            limits[pack]};
  }
  // Elements with a mean volume keep hardly any bulk modulus at points: a larger modulus would lock
  // in plastic flow, which has no other stiffness.
  auto split() const {
    const double kept = weight_of_parts * std::min(bulk(), 2 * lame.mu / 3);
    const VonMises shape{{lame.mu, kept - 2 * lame.mu / 3}, yield_stress, hardening, viscosity};
    return MaterialSplit<VonMises, VonMises, LogVolume>{shape, shape, {bulk() - kept}};
  }
  // Returns the largest elastic |dev e| at an accumulated plastic strain.
  double limit(double strain) const {
    return std::sqrt(2.0 / 3) * (yield_stress + hardening * strain) / (2 * lame.mu);
  }
  // Returns the plastic strain of the return mapping for a trial |dev e| beyond the limit by r.
  double flow(double r) const {
    if (viscosity > 0 && h == 0) return 0;
    return r > 0 ? std::sqrt(2.0 / 3) * r * 3 * lame.mu / (3 * lame.mu + slope()) : 0;
  }
  // Returns the work per volume of plastic flow that adds to an accumulated strain [J/m^3].
  double work(double strain, double added) const {
    return added * (yield_stress + hardening * (strain + added / 2));
  }
  // Returns the viscous dissipation: the stress beyond the yield surface of the end of the step,
  // times the flow [J/m^3].
  double viscous_work(double added) const {
    return added > 0 && viscosity > 0 ? viscosity * added * added / h : 0;
  }

 private:
  // Returns d stress / d plastic strain [Pa]
  double slope() const { return viscosity > 0 ? hardening + viscosity / h : hardening; }
  double bulk() const { return lame.lambda + 2 * lame.mu / 3; }
};

}  // namespace tack
