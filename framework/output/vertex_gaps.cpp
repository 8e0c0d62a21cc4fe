#include "framework/output/vertex_gaps.hpp"

#include <cmath>
#include <limits>

#include "framework/contact/contact_system.hpp"
#include "framework/contact/stencil_distance.hpp"

namespace tack {

VecX vertex_gaps(const ContactSystem& contact, const VecX& x) {
  VecX gaps = VecX::Constant(x.size() / 3, std::numeric_limits<double>::quiet_NaN());
  const auto& laws = contact.pairs().laws();
  for_each_kind(contact.contacts(), [&](auto kind, const auto& stencils, const double*) {
    for (const auto& s : stencils) {
      const double gap = std::sqrt(stencil_distance<ValueKernels>(kind, x, s)) - laws[s.law].offset();
      for (const int v : s.vertices) gaps(v) = std::fmin(gaps(v), gap);
    }
  });
  return gaps;
}

}  // namespace tack
