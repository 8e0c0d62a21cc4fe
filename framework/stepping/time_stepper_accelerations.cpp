// Accelerations that no step has computed: of initial states, of released vertices, and by dynamic
// terms.
#include "framework/contact/contact_history.hpp"
#include "framework/core/damping_terms.hpp"
#include "framework/core/term_gradient.hpp"
#include "framework/load/following_load.hpp"
#include "framework/stepping/friction_account.hpp"
#include "framework/stepping/time_stepper.hpp"
#include "framework/world/consistent_mass.hpp"

namespace tack {

// Begins at a state that no step has computed: erases the history of steps. Accelerations must be set
// afterwards.
void TimeStepper::begin_without_history() {
  state_.a = VecX::Zero(state_.x.size());
  state_.history.erase(friction_account_name);
  erase_contact_history(state_.history);
  stepper_->erase_history(state_.history);
}

// Sets the accelerations of vertices at time t [s] to M^-1 times the forces, for the step of Newmark
// and the first guess.
void TimeStepper::set_accelerations(double t, const std::vector<int>& vertices) {
  if (vertices.empty() || !integrator_->predict(state_, time_.step).inertia) return;
  for (LinearTerm* term : {static_cast<LinearTerm*>(&world_.gravity_term), static_cast<LinearTerm*>(&world_.load_term)})
    term->begin_step({state_.x, t});
  const EndVelocity now{1 / time_.step, state_.x - time_.step * state_.v};
  const StepStart moment{state_.x, t, 0, &now, &state_.v};
  for (FollowingLoad* load : world_.following_loads) load->begin_step(moment);
  for (const auto& term : world_.damping_terms) term->begin_step(moment);
  for (const auto& term : world_.elastic_terms)
    if (!term->stores()) term->begin_step(moment);
  VecX q;
  world_.dofs.gather(state_.x, q);
  potential_->begin_step(state_.x, state_.x, {}, false);
  potential_->move_to(q);
  const VecX& gradient = potential_->gradient();
  const VecX accelerations = accelerations_by(-gradient);
  for (const int v : vertices) vertex(state_.a, v) = accelerations.segment<3>(3 * world_.dofs.block(v));
  world_.dofs.update_dependents(state_.a);
  if (dynamic_terms_.empty()) return;
  const VecX contact = dynamic_accelerations(state_.x);
  if (state_.contact.size() == 0) state_.contact = VecX::Zero(contact.size());
  for (const int v : vertices) vertex(state_.contact, v) = vertex(contact, v);
  world_.dofs.update_dependents(state_.contact);
}

// Returns the accelerations by forces on the unknowns. Joints couple their masses; without joints
// the diagonal of W^T M W is used.
VecX TimeStepper::accelerations_by(const VecX& force) const {
  if (!world_.constraints.joints().empty()) return divide_by_mass(world_.dofs, world_.mass, force);
  const VecX mass = world_.dofs.block_masses(world_.mass);
  VecX a = VecX::Zero(force.size());
  for (int b = 0; b < world_.dofs.block_count(); ++b)
    if (mass(b) > 0) a.segment<3>(3 * b) = force.segment<3>(3 * b) / mass(b);
  return a;
}

// Returns the accelerations of all moving vertices by the dynamic terms (3n), which must be at x
// (move_to).
VecX TimeStepper::dynamic_accelerations(const VecX& x) const {
  const DofMap& dofs = world_.dofs;
  VecX force = VecX::Zero(x.size());
  for (const Term* term : dynamic_terms_) add_term_gradient(*term, x, force);
  force = -force;
  dofs.move_to_independents(force);
  VecX of_blocks, a = VecX::Zero(force.size());
  dofs.gather(force, of_blocks);
  of_blocks = accelerations_by(of_blocks);
  for (int b = 0; b < dofs.block_count(); ++b) vertex(a, dofs.vertex_of_block(b)) = of_blocks.segment<3>(3 * b);
  dofs.update_dependents(a);
  return a;
}

}  // namespace tack
