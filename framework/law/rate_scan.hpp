// Peak traction and work of a bond that is opened at constant speeds. A law may depend on the speed
// within a band alone: a Maxwell branch dissipates neither far below nor far above its relaxation
// rate. So the whole range of speeds is scanned, three to a decade.
#pragma once

#include "framework/bond/bond_law.hpp"
#include "framework/law/studied_law.hpp"

namespace tack {

struct RatePoint {
  double speed = 0;  // m/s; 0: quasi-static
  double peak = 0;   // Pa
  double work = 0;  // until the bond has failed, or to 16 times the opening of quasi-static failure
                    // [J/m^2]
};

struct RateScan {
  RatePoint slow;                 // quasi-static
  std::vector<RatePoint> points;  // ascending speeds
  // The smallest speed at which peak or work differ from their quasi-static values by a tenth
  // [m/s]; infinity: none of the scan.
  double effect_speed = 0;
  // Speed of the largest work, or else of the largest peak, if the scan has it within its range and
  // it exceeds the quasi-static value by a tenth [m/s]; else 0.
  double largest_speed = 0;

  bool rate_dependent() const;
};

// Scans speeds from 1e-8 to 1e8 openings per second. Laws that are integrated explicitly are
// scanned from the speed at which their longest step is still resolved. Appends key quantities: the
// speeds at which peak and work change by a tenth, the largest and smallest values.
// angle: of the opening to the normal [rad]. opening_end: opening at which the bond has failed
// under slow loading [m].
RateScan scan_rates(const BondLaw& law, double angle, double opening_end,
                    std::vector<KeyQuantity>& quantities);

}  // namespace tack
