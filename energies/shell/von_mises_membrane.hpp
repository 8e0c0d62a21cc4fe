// Von Mises plasticity of a membrane in plane stress, in Hencky strain e = ln s of the trial
// deformation F Fp^-1, Fp that of the start of the step; for several triangles side by side.
// With (p, q) = (e1 + e2, (e1 - e2) / sqrt 3), the elastic density and the equivalent strain of an
// isochoric flow are
//     1/2 (A p^2 + B q^2),   g = |(p', q')|,   A = mu + lambda,   B = 3 mu,
// lambda = E nu / (1 - nu^2), and the stress conjugate to them, t = (A p, B q), has von Mises'
// stress as its length. So the least of elastic energy and plastic work over all plastic flows (the
// augmented density),
//     psi = min_f  1/2 (A (p - p')^2 + B (q - q')^2) + Y g + H/2 g^2,
//     Y = sigma_y + H a,   a the accumulated strain,
// is a projection onto a circle in a metric of two numbers, where the length g solves
//     (A p)^2 / ((A + H) g + Y)^2 + (B q)^2 / ((B + H) g + Y)^2 = 1,
// which is convex and falls in g: Newton's method from 0 does not overshoot. The stress is the
// return-mapped one, Kirchhoff's in the sheet of the thickness at rest. With a viscosity eta, |t| =
// Y + H g + eta g/h over a step h: H + eta/h takes the place of H. Between steps, h = 0, nothing
// flows (plasticity/von_mises.hpp). Source: Li, Li, Jiang 2022, Energetically Consistent
// Inelasticity; Simo and Taylor 1986 for the return in plane stress.
#pragma once

#include <cmath>

#include "energies/shell/membrane.hpp"

namespace tack {

// Result of a return mapping: principal logarithmic strains of the flow and its length, 0 if
// elastic.
struct PlaneFlow {
  PackVec2 strain;
  Pack amount;
};

struct VonMisesMembraneLanes {
  double bulk, shear;  // A and B [Pa]
  double hardening;    // H [Pa]
  Pack yield;          // Y [Pa]

  Pack energy(const PlaneStrain&, const PackMat32& f) const {
    const PackVec2 s = plane_stretch(f).s;
    const Return r = mapped(s);
    const Pack p = r.stress(0) / bulk, q = r.stress(1) / shear;
    const Pack psi =
        0.5 * (r.stress(0) * p + r.stress(1) * q) + r.amount * (yield + hardening / 2 * r.amount);
    return select(s.prod() > 0, psi, std::numeric_limits<double>::infinity());
  }

  PlaneDerivatives derivatives(const PackVec2& s) const {
    const Return r = mapped(s);
    // dt/d(p, q) = C - C (C + M)^-1 C, M = Y'/g (I - n n^T) + H n n^T, Y' = Y + H g, n the
    // direction of the flow.
    const PackMask flows = r.amount > 0;
    const Pack secant = (yield + hardening * r.amount) / select(flows, r.amount, 1);
    const Pack nn = r.direction(0) * r.direction(0), mm = r.direction(1) * r.direction(1),
               nm = r.direction(0) * r.direction(1);
    const Pack a = bulk + secant + (hardening - secant) * nn,
               b = shear + secant + (hardening - secant) * mm;
    const Pack c = (hardening - secant) * nm, det = a * b - c * c;
    const Pack pp = select(flows, bulk - bulk * bulk * b / det, bulk);
    const Pack qq = select(flows, shear - shear * shear * a / det, shear);
    const Pack pq = select(flows, bulk * shear * c / det, 0);
    // tau_1,2 = t_p +- t_q / sqrt 3.
    const Pack side = r.stress(1) / root3, mixed = pq / root3;
    PackVec2 tau;
    PackMat2 h;
    for (int i = 0; i < 2; ++i) {
      const double sign = i == 0 ? 1 : -1;
      tau(i) = r.stress(0) + sign * side;
      h(i, i) = pp + qq / 3 + 2 * sign * mixed;
    }
    h(0, 1) = h(1, 0) = pp - qq / 3;
    return of_logarithms(s, tau, h);
  }

  // The state stays inside the yield surface by more than round-off, so that a sheet at rest does
  // not flow.
  PlaneFlow flow(const PackVec2& s) const {
    constexpr double inside = 1e-13;
    const Return r = mapped(s);
    const Pack p = (r.amount + inside) * r.direction(0),
               q = (r.amount + inside) * r.direction(1) * root3;
    return {PackVec2((p + q) / 2, (p - q) / 2), r.amount};
  }

 private:
  static constexpr double root3 = 1.7320508075688772935;

  struct Return {
    PackVec2 stress;     // t
    PackVec2 direction;  // of the flow; zero without one
    Pack amount;         // g
  };

  Return mapped(const PackVec2& s) const {
    const Pack e0 = log(s(0)), e1 = log(s(1));
    const Pack tp = bulk * (e0 + e1), tq = shear * ((e0 - e1) / root3);
    const PackMask beyond = tp * tp + tq * tq > yield * yield;
    Return r{{tp, tq}, {0, 0}, 0};
    if (!any(beyond)) return r;
    const Pack ap = bulk + hardening, aq = shear + hardening;
    Pack g = 0;
    for (int i = 0; i < 60; ++i) {
      // Newton's method on |.|^-1 - 1 of the condition, which is nearly linear in g.
      const Pack dp = 1 / (ap * g + yield), dq = 1 / (aq * g + yield);
      const Pack np = tp * dp, nq = tq * dq, square = np * np + nq * nq, length = sqrt(square);
      const Pack slope = ap * dp * np * np + aq * dq * nq * nq;
      const Pack change = select(beyond, (length - 1) * square / select(slope > 0, slope, 1), 0);
      g += change;
      if (!any(abs(change) > 1e-15 * (g + yield / ap))) break;
    }
    const Pack np = tp / (ap * g + yield), nq = tq / (aq * g + yield),
               length = sqrt(np * np + nq * nq);
    const Pack scale = select(beyond & (g > 0), 1 / select(length > 0, length, 1), 0);
    r.direction = PackVec2(np * scale, nq * scale);
    r.amount = select(beyond & (g > 0), g, 0);
    const Pack now = yield + hardening * r.amount;
    r.stress = PackVec2(select(beyond, now * r.direction(0), tp),
                        select(beyond, now * r.direction(1), tq));
    return r;
  }
};

// Material of a sheet whose triangles have a yield surface each.
struct VonMisesMembrane {
  VonMisesMembrane(const PlaneStress& lame, double yield_stress_, double hardening_,
                   double viscosity_ = 0)
      : elastic(lame), yield_stress(yield_stress_), hardening(hardening_), viscosity(viscosity_) {}

  PlaneStress elastic;
  double yield_stress;            // sigma_y [Pa]
  double hardening;               // H: yield stress per accumulated plastic strain [Pa]
  double viscosity;               // eta [Pa s]
  std::vector<Pack> yields = {};  // of pack_width triangles each
  double h = 0;                   // step size [s], with viscosity only

  VonMisesMembraneLanes at(int pack) const {
    constexpr double out_of_reach = 1e100;  // Pa
    if (viscosity > 0 && h == 0)
      return {elastic.mu + elastic.lambda, 3 * elastic.mu, hardening, out_of_reach};
    return {elastic.mu + elastic.lambda, 3 * elastic.mu,
            viscosity > 0 ? hardening + viscosity / h : hardening, yields[pack]};
  }
  double yield(double strain) const { return yield_stress + hardening * strain; }
  // Returns the work per volume of plastic flow that adds to an accumulated strain [J/m^3].
  double work(double strain, double added) const {
    return added * (yield_stress + hardening * (strain + added / 2));
  }
  double viscous_work(double added) const {
    return viscosity > 0 ? viscosity * added * added / h : 0;
  }
};

}  // namespace tack
