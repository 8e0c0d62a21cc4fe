// Penalty of the augmented Lagrangian that moves prescribed vertices (prescribed_motion.hpp), from
// one minimisation to the next, as a function of the largest distance of a vertex to its target:
//   reached       distance <= enough, at first a fraction of the displacement
//   update        multipliers, if the minimisation halved the distance; otherwise K grows tenfold
//   blocked       30 iterations without 1% less distance or a larger K, or K above 1e8 times the
//                 first one
// (Nocedal and Wright 2006, Numerical Optimization, algorithm 17.4; Li et al. 2020, Incremental
// Potential Contact, supplement A.)
#pragma once

namespace tack {

class PenaltyRule {
 public:
  // stiffness: the first K. distance: at the start [m]. remainder: fraction of it that is enough.
  PenaltyRule(double stiffness, double distance, double remainder)
      : first_(stiffness), stiffness_(stiffness), left_(distance), smallest_(distance),
        enough_(remainder * distance) {}

  double stiffness() const { return stiffness_; }
  bool blocked() const;
  bool reached(double distance) const { return distance <= enough_; }

  // Returns the stopping norm of an iterate of a minimisation: at most 1 if the distance is enough,
  // or if it will hardly change; 0 if the motion is blocked. own_step: largest displacement of a
  // prescribed vertex under the direction [m].
  double norm(double distance, double own_step);
  // The targets could not be set from the distance: less is enough.
  void come_closer(double distance);
  // Begins the next minimisation. Returns the factor by which K grows; 1: multipliers are updated.
  double next(double distance);

 private:
  double first_, stiffness_;  // K, relative to the masses of the incremental potential
  double left_;               // distance after the last minimisation [m]
  double smallest_;           // smallest distance, but for changes below 1% [m]
  double enough_;             // m
  int idle_ = 0;              // iterations since smallest_ fell or K grew
};

}  // namespace tack
