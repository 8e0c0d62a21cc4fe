#include "framework/stepping/accelerations.hpp"

#include <algorithm>
#include <iterator>

#include "framework/core/damping_terms.hpp"
#include "framework/core/term_gradient.hpp"
#include "framework/load/following_load.hpp"
#include "framework/world/consistent_mass.hpp"

namespace tack {

Accelerations::Accelerations(World& world, const TimeIntegrator& integrator, double step) : world_(world), integrator_(integrator), step_(step) {
  if (integrator.follows_contact())
    std::copy_if(world.terms.begin(), world.terms.end(), std::back_inserter(dynamic_terms_), [](const Term* term) { return term->dynamic(); });
}

void Accelerations::set(State& state, double t, const std::vector<int>& vertices, StepPotential& potential) {
  if (vertices.empty() || !integrator_.inertia()) return;
  for (LinearTerm* term : {static_cast<LinearTerm*>(&world_.gravity_term), static_cast<LinearTerm*>(&world_.load_term)})
    term->begin_step({state.x, t});
  const EndVelocity now{1 / step_, state.x - step_ * state.v};
  const StepStart moment{state.x, t, 0, &now, &state.v};
  for (FollowingLoad* load : world_.following_loads) load->begin_step(moment);
  for (const auto& term : world_.damping_terms) term->begin_step(moment);
  for (const auto& term : world_.elastic_terms)
    if (!term->stores()) term->begin_step(moment);
  VecX q;
  world_.dofs.gather(state.x, q);
  potential.begin_step(state.x, state.x, {}, false);
  potential.move_to(q);
  const VecX& gradient = potential.gradient();
  const VecX accelerations = by(-gradient);
  for (const int v : vertices) vertex(state.a, v) = accelerations.segment<3>(3 * world_.dofs.block(v));
  world_.dofs.update_dependents(state.a);
  if (dynamic_terms_.empty()) return;
  const VecX contact = dynamic(state.x);
  if (state.contact.size() == 0) state.contact = VecX::Zero(contact.size());
  for (const int v : vertices) vertex(state.contact, v) = vertex(contact, v);
  world_.dofs.update_dependents(state.contact);
}

VecX Accelerations::by_dynamic_terms(const VecX& x) const {
  if (dynamic_terms_.empty()) return {};
  world_.participants.move_to(x);
  return dynamic(x);
}

// Returns the accelerations by forces on the unknowns. Joints couple their masses; without joints
// the diagonal of W^T M W is used.
VecX Accelerations::by(const VecX& force) const {
  if (!world_.constraints.joints().empty()) return divide_by_mass(world_.dofs, world_.mass, force);
  const VecX mass = world_.dofs.block_masses(world_.mass);
  VecX a = VecX::Zero(force.size());
  for (int b = 0; b < world_.dofs.block_count(); ++b)
    if (mass(b) > 0) a.segment<3>(3 * b) = force.segment<3>(3 * b) / mass(b);
  return a;
}

// Returns the accelerations by the dynamic terms, which must be at x.
VecX Accelerations::dynamic(const VecX& x) const {
  const DofMap& dofs = world_.dofs;
  VecX force = VecX::Zero(x.size());
  for (const Term* term : dynamic_terms_) add_term_gradient(*term, x, force);
  force = -force;
  dofs.move_to_independents(force);
  VecX of_blocks, a = VecX::Zero(force.size());
  dofs.gather(force, of_blocks);
  of_blocks = by(of_blocks);
  for (int b = 0; b < dofs.block_count(); ++b) vertex(a, dofs.vertex_of_block(b)) = of_blocks.segment<3>(3 * b);
  dofs.update_dependents(a);
  return a;
}

}  // namespace tack
