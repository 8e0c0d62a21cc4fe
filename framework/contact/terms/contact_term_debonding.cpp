// Marks surfaces that a motion takes past the peak of an adhesion of the gap, by the stencils of the
// configuration at the start of the motion.
#include <cmath>

#include "framework/contact/terms/contact_term.hpp"
#include "framework/contact/laws/law_debonding.hpp"
#include "framework/contact/stencils/stencil_distance.hpp"
#include "framework/core/concurrent_maximum.hpp"
#include "geometry/parallel.hpp"

namespace tack {

void ContactTerm::mark_debonding(const VecX& from, const VecX& to, std::vector<char>& vertices) const {
  std::vector<double> range;  // of the adhesion of each law; 0: none [m]
  bool any = false;
  for (const PairLaw& law : laws(LawTerm::adhesion)) {
    range.push_back(law.laws().empty() ? 0 : law.range());
    any = any || range.back() > 0;
  }
  if (!any) return;
  for_each_kind(system_.contacts(), [&](auto kind, const auto& stencils, const double*) {
    using K = decltype(kind);
    for_each(static_cast<int>(stencils.size()), [&](int i) {
      const auto& stencil = stencils[i];
      if (!(range[stencil.law] > 0) || !(stencil.weight > 0)) return;
      const auto distance_at = [&](const VecX& x) { return std::sqrt(stencil_distance<ValueKernels>(K{}, x, stencil)); };
      if (!passes_peak(laws(LawTerm::all)[stencil.law], range[stencil.law], distance_at(from), distance_at(to))) return;
      for (const int v : stencil.vertices) mark(vertices[v]);
    });
  });
}

}  // namespace tack
