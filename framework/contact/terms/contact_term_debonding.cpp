// Marks surfaces by how far a motion takes their adhesion of the gap, by the stencils of the
// configuration at the start of the motion.
#include <algorithm>
#include <cmath>

#include "framework/contact/terms/contact_term.hpp"
#include "framework/contact/laws/law_debonding.hpp"
#include "framework/contact/stencils/stencil_distance.hpp"
#include "framework/core/concurrent_maximum.hpp"
#include "geometry/parallel.hpp"

namespace tack {

void ContactTerm::mark_debonding(const VecX& from, const VecX& to, std::vector<char>& marks) const {
  std::vector<AdhesionOfGap> adhesion;  // of each law
  for (const PairLaw& law : laws(LawTerm::adhesion)) adhesion.emplace_back(law);
  if (std::none_of(adhesion.begin(), adhesion.end(), [](const AdhesionOfGap& a) { return a.range > 0; })) return;
  for_each_kind(system_.contacts(), [&](auto kind, const auto& stencils, const double*) {
    using K = decltype(kind);
    for_each(static_cast<int>(stencils.size()), [&](int i) {
      const auto& stencil = stencils[i];
      if (!(adhesion[stencil.law].range > 0) || !(stencil.weight > 0)) return;
      const auto distance_at = [&](const VecX& x) { return std::sqrt(stencil_distance<ValueKernels>(K{}, x, stencil)); };
      const char found = debonding_marks(laws(LawTerm::all)[stencil.law], adhesion[stencil.law], distance_at(from), distance_at(to));
      for (const int v : stencil.vertices) mark(marks[v], found);
    });
  });
}

}  // namespace tack
