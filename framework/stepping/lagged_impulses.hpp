// Friction that lags by a step: it applies mu times every normal impulse, one step later.
//
// A force N_n at the end of step n acts on velocities for a time T: T = h, but 2h/3 in a step of
// BDF2, whose velocities then go on by a = 1/3 of their last gain. The impulses of step n are
//     p_n = a p_(n-1) + T N_n        (normal),
//     q_n = a q_(n-1) + T N'_n       (friction over mu).
// In equal steps N'_(n+1) = N_n gives q_(n+1) = p_n. In a step of another size or integrator the
// same force is another impulse. Therefore each pair of objects keeps an account of the impulse
// error, owed = sum of all p less sum of all q:
//     q_(n+1) = (1 - s) p_n h_(n+1) / h_n + s owed.
//
//   s = 0   lasting contact: keeps its force, whatever the size of steps. Its force stayed within a
//           quarter for at least four times the next step, or it existed when the run began.
//   s = 1   contact that comes or goes: gets the impulse that is owed. Its force was steady
//           for less than twice the next step.
//   between: linear.
//
// Start-up: no step has found the forces at the start of a run, and a body placed inside a barrier
// presses with any force. Steps are therefore solved again with the normal forces of their latest
// solution (q_n = p_n) for pairs whose friction was applied with a tenth more than they press. From
// the first step without such an excess on, friction of the pair lags.
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
  // masses: of the objects [kg]; tolerance: velocity changes below it are neglected [m/s].
  LaggedImpulses(FrictionTerm& friction, std::vector<double> masses, double tolerance);

  // Sets the lagged normal forces of friction for the step of size h that begins at the state.
  // acting: time for which contact acts on velocities [s].
  void begin(const State& state, double h, double acting);
  // Returns whether the step has to be solved again, with the normal forces set here. To be called
  // after a solve whose solution has the contact points `now`.
  bool settle(const ContactPoints& now);
  // History of the step, to be stored once it is kept, and the time for which contact acted in it.
  HistoryArray remembered() const { return array_of(accounts_); }
  double acting() const { return acting_; }
  // The pair of objects whose friction and pressure differ most, if newly found: by more than a
  // tenth in the sum over all steps since they touched, beyond the lag of one step.
  struct Difference {
    std::array<int, 2> objects;
    double given, normal;  // N s
    int others;            // number of further such pairs
  };
  const std::optional<Difference>& difference() const { return difference_; }

 private:
  double unnoticed(const std::array<int, 2>& objects) const;
  void compare(const FrictionTerm::PairForces& forces);

  FrictionTerm& friction_;
  std::vector<double> masses_;
  double tolerance_;
  // Present step:
  double acting_ = 0, kept_ = 0;  // T [s], a
  FrictionAccounts accounts_;
  std::map<std::array<int, 2>, double> carried_;  // a q_(n-1) [N s]
  int solves_ = 0;
  std::optional<Difference> difference_;
};

}  // namespace tack
