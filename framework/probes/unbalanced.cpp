#include "framework/probes/unbalanced.hpp"

#include "framework/core/term_gradient.hpp"

namespace tack {

VecX unbalanced_forces(const World& world, const State& state) {
  VecX gradient = VecX::Zero(state.x.size());
  for (const Term* term : world.terms)
    if (!world.records.replaced(*term)) add_term_gradient(*term, state.x, gradient);
  for (const ForceRecord& record : world.records.forces())
    if (!record.term) {
      VecX forces = VecX::Zero(gradient.size());
      record.add(state.x, "", forces);
      gradient -= forces;
    }
  for (int v = 0; v < world.dofs.vertex_count(); ++v) vertex(gradient, v) += world.mass(v) * vertex(state.a, v);
  return gradient;
}

}  // namespace tack
