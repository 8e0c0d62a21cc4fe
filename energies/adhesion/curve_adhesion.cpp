#include "energies/adhesion/curve_adhesion.hpp"

#include <cmath>

namespace tack {
namespace {

constexpr double largest_end = 1e-3;  // fraction of the peak that law_check tolerates
constexpr double least_felt = 0.99;   // of the peak

}  // namespace

void check_traction(const CubicCurve& curve, bool cut, double contact_distance, const std::string& what) {
  const CubicCurve::Point peak = curve.largest();
  if (!(peak.value > 0) || !(curve.total() > 0))
    throw InputError(fmt::format("{}: pushes more than it pulls (the integral of its traction is {:.4g} J/m^2): tractions that pull are positive", what,
                                 curve.total()));
  const double end = curve.at(curve.last()).value;
  if (!cut && std::abs(end) > largest_end * peak.value)
    throw InputError(fmt::format("{}: its traction ends with {:.4g} Pa at {:.6g} m, {:.2g}% of the largest: let it go on until it is 0, or take the jump with "
                                 "`cut: true`", what, end, curve.last(), 100 * std::abs(end) / peak.value));
  if (curve.last() <= contact_distance || curve.largest(contact_distance).value < least_felt * peak.value)
    throw InputError(fmt::format("{}: its traction peaks at {:.6g} m, below the contact distance {:.6g} m, where the barrier pushes; lower contact.distance, "
                                 "or move the peak out", what, peak.x, contact_distance));
}

}  // namespace tack
