// Nonequilibrium network of an elastomer, after Bergstrom and Boyce, for several tets side by side.
// The deformation F = F_e F_v has an elastic and a viscous part, e = ln s(F_e). The network stores
//     psi(F_e) = mu |dev e|^2 ,
// and flows without change of volume along its deviatoric Kirchhoff stress tau = 2 mu dev e,
//     D_v = sqrt(3/2) d dev e / |dev e|,   d = d_0 (lambda_v - 1 + xi)^C (sigma / sigma_0)^m ,
// with the equivalent (von Mises) stress sigma = sqrt(3/2) |tau|, the equivalent rate d, and the
// stretch lambda_v = sqrt(tr(F_v F_v^T) / 3) of chains. A step takes lambda_v of its start and
// flows by D_v of its end: backward Euler, of first order, with the exponential map along the
// principal axes of the trial strain (network_flow.hpp). The potential is isotropic in F F_v^-1 at
// the fixed F_v of the start. Between steps, h = 0, it is the stored energy. m = 1, C = 0 is a
// Maxwell branch (maxwell.hpp) of the time sigma_0 / (3 mu d_0). Sources: Bergstrom and Boyce 1998,
// Constitutive modeling of the large strain time-dependent behavior of elastomers (the flow); Reese
// and Govindjee 1998, A theory of finite viscoelasticity (the split of F, the exponential map);
// Ortiz and Stainier 1999 (the potential). Bergstrom and Boyce have springs of eight chains, which
// stiffen; these are linear in Hencky strain.
#pragma once

#include <Eigen/LU>
#include <vector>

#include "energies/solid/isotropic_solid.hpp"
#include "energies/solid/svd3.hpp"
#include "energies/viscoelastic/network_flow.hpp"

namespace tack {

struct BergstromBoyceLanes {
  const NetworkFlow& flow;
  Pack log_factor;  // ln k

  Pack energy(const PackMat3& f) const {
    const Strain e = strain(svd3(f).s);
    const Pack potential = flow.potential(flow.fractions(e.norm, log_factor));
    return select(f.determinant() > 0, flow.mu * e.norm * e.norm * potential, infinity);
  }

  PrincipalDerivatives derivatives(const PackVec3& s) const {
    const Strain e = strain(s);
    const NetworkFlow::Fractions<Pack> fractions = flow.fractions(e.norm, log_factor);
    // tau = c dev e, dtau/de = c (1 - 1/3) + w dev e dev e^T; c: secant stiffness, w: its decrease.
    const Pack c = 2 * flow.mu * fractions.left;
    const Pack norm = select(e.norm > smallest_norm, e.norm, 1);
    const Pack w = select(e.norm > smallest_norm,
                          (2 * flow.mu * flow.tangent(fractions) - c) / (norm * norm), 0);
    PackVec3 tau;
    PackMat3 h;
    for (int i = 0; i < 3; ++i) {
      tau(i) = c * e.deviator(i);
      for (int k = 0; k < 3; ++k) h(i, k) = w * e.deviator(i) * e.deviator(k) - c / 3;
    }
    return of_logarithms(s, tau, h, c);
  }

 private:
  static constexpr double smallest_norm = 1e-150;  // whose square is a number

  struct Strain {
    PackVec3 deviator;
    Pack norm;
  };
  static Strain strain(const PackVec3& s) {
    Strain e;
    for (int i = 0; i < 3; ++i) e.deviator(i) = log(s(i));
    const Pack mean = e.deviator.sum() / 3;
    for (int i = 0; i < 3; ++i) e.deviator(i) -= mean;
    e.norm = sqrt(e.deviator.squaredNorm());
    return e;
  }
};

// Material of a body whose samples (tets, or points of them) have a flow each.
struct BergstromBoyce {
  NetworkFlow flow;
  std::vector<Pack> log_factors = {};  // of pack_width tets each

  BergstromBoyceLanes at(int pack) const { return {flow, log_factors[pack]}; }
  // A split without volume: a network has none.
  auto split() const {
    return MaterialSplit<BergstromBoyce, BergstromBoyce, LogVolume>{*this, *this, {0}};
  }
};

}  // namespace tack
