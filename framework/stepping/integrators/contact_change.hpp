// Change of contact over a step, for integrators that look back. Contact stands for all dynamic
// terms here, friction, bonds and terms of plugins included (State::contact).
//
// Contact as an impulse (Kane, Repetto, Ortiz and Marsden 1999, Finite element analysis of
// nonsmooth contact): a stage of length h from xb, vb to x', v' has
//     x' = [other terms] + h^2 (k (c' + s) + (r - k) z cb),   v' = [other terms] + h (c' + s),
// c', cb the accelerations by contact at its end and start. With k >= 1/2, and without s and z, the
// work of contact c' M (x' - xb) is at least the kinetic energy that it adds: no energy is made for
// a convex potential, whatever h. r is the weight with which a constant acceleration by the other
// terms acts on x' (1/2 where the stage is of second order): a body at rest stays there. Both
// corrections make lasting contact second order:
//     s = - z / 2 (change of c over the stage before, scaled to h)   moves the force to the middle,
// with the smoothness z of contact: 1 if it did not change over the stage before, 0 if it was made,
// lost, or changed by a quarter.
#pragma once

#include <string>

#include "framework/stepping/time_integrator.hpp"

namespace tack {

// Contact is smooth if its accelerations change in a step by less than this fraction of the largest
// one. Otherwise Newmark's correction is zero, and BDF2 drops its history.
inline constexpr double smooth_contact_change = 0.25;

// Returns the change of contact from `before` to `contact` (3n): 0 (none) to 1 (contact made or
// lost, or changed by at least the fraction smooth_contact_change).
double contact_change(const VecX& before, const VecX& contact);
// Returns the change of contact over the stage before.
inline double contact_change(const State& s) { return contact_change(s.contact_before, s.contact); }

// Returns h over the size of the step before, for two-step formulas: 1, or the ratio of adaptive
// steps. Returns 0 if the step before may not be used.
double step_ratio(const State& s, double h);

// Contact as an impulse of a stage.
struct ContactImpulse {
  // usual_before: length of the stage before in steps of one size [s]. Corrections are zero after
  // a stage of another length, unless steps adapt.
  ContactImpulse(const State& s, double h, double usual_before);
  // Returns s, and z cb (3n); empty: zero.
  VecX shift, smooth;
  // Adds the known part of the impulse to a prediction. weight: k; smooth_weight: r.
  void add_to_prediction(double h, double weight, double smooth_weight, VecX& x) const;
};

// Returns the accelerations by all terms but the dynamic ones (3n).
inline VecX without_contact(const VecX& a, const VecX& contact) {
  return contact.size() > 0 ? VecX(a - contact) : a;
}

// Returns advice on a numerical energy gain.
std::string energy_gain_advice(bool contact);
// Advice on a numerical energy loss in contact, by integrators that take contact as an impulse.
inline constexpr const char* short_contact_advice =
    "contact that comes and goes within a few steps gives back a part of the energy only: "
    "refine time.step until it lasts for many";

}  // namespace tack
