// Energy stored by each contact stencil and dissipated at each contact point (Term::visit_energies):
// needed once per step, in scenes with several groups of bodies.
#include <cmath>

#include "framework/contact/terms/contact_term.hpp"
#include "framework/contact/terms/friction_term.hpp"
#include "framework/contact/terms/slip.hpp"
#include "framework/contact/stencils/stencil_distance.hpp"
#include "geometry/distance/edge_edge_mollifier.hpp"

namespace tack {

bool ContactTerm::visit_energies(const VecX& x, const EnergyVisitor& visit) const {
  for_each_kind(system_.contacts(), [&](auto kind, const auto& stencils, const double* thresholds) {
    for (size_t i = 0; i < stencils.size(); ++i) {
      const auto& v = stencils[i].vertices;
      const double gap = std::sqrt(stencil_distance<ValueKernels>(kind, x, stencils[i]));
      double energy = 0;
      laws(LawTerm::all)[stencils[i].law].values(1, &gap, &energy);
      energy *= stencils[i].weight;
      if constexpr (std::is_same_v<decltype(kind), EdgeEdgeKind>)
        energy *= edge_edge_mollifier(vertex(x, v[0]), vertex(x, v[1]), vertex(x, v[2]), vertex(x, v[3]), thresholds[i]);
      visit(v, energy);
    }
  });
  return true;
}

void FrictionTerm::visit_dissipation(const VecX& x, const EnergyVisitor& visit) const {
  const auto dissipated_at = [&](const auto& point) {
    const Slip slip(point, x, start_);
    const TangentialLaw& law = system_.pairs().tangential(point.law);
    return slip.work(slip.sample(law, h_, TangentialTerm::all), law);
  };
  for_each_record(sliding(), [&](const auto& point) { visit(point.vertices, dissipated_at(point)); });
  for (const RollingGroup& group : rolling_)
    for (const RollingPoint& point : group.points) visit(std::span(point.vertices).first(point.arity()), dissipated_at(point));
}

}  // namespace tack
