#include "framework/probes/unbalanced.hpp"

#include <algorithm>

#include "framework/core/term_gradient.hpp"

namespace tack {
namespace {

// Returns true if the last step used the trapezoidal rule: it has accelerations, and its mean
// velocity is exactly (v + v_n) / 2 = (x - x_n) / h. The rule has no damping, so that stiff forces
// alternate from step to step about their mean.
bool alternates(const World& world, const State& state) {
  constexpr double round_off = 1e-9;
  if (state.h_before == 0 || state.x_before.size() != state.x.size() || state.v_before.size() != state.v.size()) return false;
  double off = 0, size = 0;
  for (int v = 0; v < world.dofs.vertex_count(); ++v) {
    if (!world.dofs.owns(v)) continue;
    const Vec3 mean = (vertex(state.v, v) + vertex(state.v_before, v)) / 2, velocity = (vertex(state.x, v) - vertex(state.x_before, v)) / state.h_before;
    off = std::max(off, (mean - velocity).lpNorm<Eigen::Infinity>());
    size = std::max(size, mean.lpNorm<Eigen::Infinity>());
  }
  return size > 0 && off <= round_off * size;
}

}  // namespace

VecX unbalanced_forces(const World& world, const State& state) {
  const bool mean = alternates(world, state);
  const auto is_elastic = [&](const Term* term) {
    return std::any_of(world.elastic_terms.begin(), world.elastic_terms.end(), [&](const auto& elastic) { return elastic.get() == term; });
  };
  VecX gradient = VecX::Zero(state.x.size());
  for (const Term* term : world.terms) {
    if (world.records.replaced(*term)) continue;
    if (!mean || term->dynamic() || !term->stores() || !is_elastic(term)) {
      add_term_gradient(*term, state.x, gradient);
      continue;
    }
    VecX both = VecX::Zero(gradient.size());
    add_term_gradient(*term, state.x_before, both);
    add_term_gradient(*term, state.x, both);
    gradient += both / 2;
  }
  for (const ForceRecord& record : world.records.forces())
    if (!record.term) {
      VecX forces = VecX::Zero(gradient.size());
      record.add(state.x, "", forces);
      gradient -= forces;
    }
  for (int v = 0; v < world.dofs.vertex_count(); ++v)
    vertex(gradient, v) += world.mass(v) * (mean ? Vec3((vertex(state.v, v) - vertex(state.v_before, v)) / state.h_before) : Vec3(vertex(state.a, v)));
  return gradient;
}

}  // namespace tack
