// Friction that lags by a step: it applies mu times every normal impulse, one step later.
//
// A force N_n at the end of step n acts on velocities for the contact time T: T = h, but 2h/3 in a
// step of BDF2, whose velocities keep a = 1/3 of their last change. The impulses of step n are
//     p_n = a p_(n-1) + T N_n        (normal),
//     q_n = a q_(n-1) + T N'_n       (friction over mu).
// In equal steps N'_(n+1) = N_n gives q_(n+1) = p_n. In a step of another size or integrator, the
// same force is another impulse. Therefore each pair of objects has an account of the accumulated
// impulse error, e = sum of all p less sum of all q:
//     q_(n+1) = (1 - s) p_n h_(n+1) / h_n + s e.
//
//   s = 0   lasting contact: its force is kept, whatever the size of steps. The force stayed within
//           a quarter for at least four times the next step, or existed when the run began.
//   s = 1   contact that comes or goes: it gets the impulse error. Its force was steady for less
//           than twice the next step.
//   between: linear.
//
// Start-up: no step has computed the forces at the start of a run, and a body placed inside a
// barrier may have any normal force. Steps are therefore solved again with the normal forces of
// their latest solution (q_n = p_n) for pairs whose friction was applied with a normal impulse that
// is a tenth too large. After the first step without such an excess, friction of the pair lags.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <vector>

#include "framework/contact/terms/friction_term.hpp"
#include "framework/core/state.hpp"
#include "framework/stepping/friction_account.hpp"

namespace tack {

class LaggedImpulses {
 public:
  // masses: of the objects [kg]; tolerance: velocity changes below it are neglected [m/s].
  LaggedImpulses(FrictionTerm& friction, std::vector<double> masses, double tolerance);

  // Sets the lagged normal forces of friction for the step of size h that begins at the state.
  // contact_time: time for which contact acts on velocities [s].
  void begin(const State& state, double h, double contact_time);
  // Sets the normal forces of pairs in start-up to those of a solution with the contact points
  // `now`. Returns whether the step has to be solved again with them.
  bool update_start_up(const ContactPoints& now);
  // Returns the history of the step, to be stored when it is accepted.
  HistoryArray history() const { return array_of(accounts_); }
  double contact_time() const { return contact_time_; }
  // Pair of objects whose impulses of friction and of contact differ most: by more than a tenth in
  // the sum over all steps since they touched, beyond the lag of one step.
  struct Difference {
    std::array<int, 2> objects;
    double applied, normal;  // N s
    int others;              // number of further such pairs
  };
  // Returns the largest difference among newly found ones.
  const std::optional<Difference>& difference() const { return difference_; }

 private:
  // Returns the impulse between two objects that velocities resolve [N s].
  double impulse_tolerance(const std::array<int, 2>& objects) const;
  // Finds pairs of a large impulse difference.
  void compare(const FrictionTerm::PairForces& forces);

  FrictionTerm& friction_;
  std::vector<double> masses_;
  double tolerance_;
  // Present step:
  double contact_time_ = 0, kept_fraction_ = 0;  // T [s], a
  FrictionAccounts accounts_;
  std::map<std::array<int, 2>, double> kept_impulses_;  // a q_(n-1) [N s]
  int solves_ = 0;
  std::optional<Difference> difference_;
};

}  // namespace tack
