// Friction that lags by a step gives mu times every normal impulse, one step later.
//
// A force that is found at the end of a step is the impulse of that step over the time T for which it acts on velocities:
// h, but 2h/3 in a step of BDF2, whose velocities then go on by a = 1/3 of what they have gained:
//     p_n = a p_(n-1) + T N_n        the normal impulse of a step,    q_n = a q_(n-1) + T N'_n    friction's, over mu.
// In steps that are all alike N'_(n+1) = N_n gives q_(n+1) = p_n. Where the next step is of another size or of another
// integrator the same force is another impulse, so what is owed, the sum of all p less that of all q, is kept for each two
// objects:
//     q_(n+1) = (1 - s) p_n h_(n+1) / h_n + s owed,
// s = 0: a contact that lasts goes on with its force, whatever the size of steps; s = 1: one that comes or goes, with the
// impulse that is due. What has lasted for four times the next step, with a force that stayed within a quarter, is expected to
// last through it; what has for less than two is not. What there was when the run began has lasted for ever.
//
// The forces of a run's beginning are those of its start, which no step has found: a body that is placed inside a barrier presses
// with any force. So steps are solved again, with the normal forces of their latest solution (q_n = p_n), for those two objects
// whose friction was given a tenth more than they press; from the first step on in which it was not, it lags.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <vector>

#include "framework/contact/friction_term.hpp"
#include "framework/core/state.hpp"
#include "framework/stepping/friction_account.hpp"

namespace tack {

class LaggedImpulses {
 public:
  // tolerance: of velocities [m/s]; what changes those of objects of these masses [kg] by less is of no account.
  LaggedImpulses(FrictionTerm& friction, std::vector<double> masses, double tolerance);

  // Sets the normal forces that friction holds for the step of size h that has begun at the state, in which contact acts on
  // velocities for `acting` [s].
  void begin(const State& state, double h, double acting);
  // After a solve of the step that friction would follow with `now`: whether it has to be solved again, with what friction
  // then holds.
  bool settle(const ContactPoints& now);
  // To be remembered of the step once it is kept, and for how long contact acted in it.
  HistoryArray remembered() const { return array_of(accounts_); }
  double acting() const { return acting_; }
  // Of the two objects of which that is newest and most: their friction was given a tenth more or less than they press, in the
  // sum over all steps since they touched and beyond what one step lags.
  struct Difference {
    std::array<int, 2> objects;
    double given, normal;  // N s
    int others;            // of which the same is to be told
  };
  const std::optional<Difference>& difference() const { return difference_; }

 private:
  double unnoticed(const std::array<int, 2>& objects) const;
  void compare(const FrictionTerm::PairForces& forces);

  FrictionTerm& friction_;
  std::vector<double> masses_;
  double tolerance_;
  // Of the present step.
  double acting_ = 0, kept_ = 0;  // T [s], a
  FrictionAccounts accounts_;
  std::map<std::array<int, 2>, double> carried_;  // a q_(n-1) [N s]
  int solves_ = 0;
  std::optional<Difference> difference_;
};

}  // namespace tack
