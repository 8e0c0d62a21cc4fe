#include "framework/output/vertex_gaps.hpp"

#include <cmath>
#include <limits>

#include "framework/contact/contact_potential.hpp"
#include "framework/contact/contact_system.hpp"

namespace tack {

VecX vertex_gaps(const ContactSystem& contact, const VecX& x) {
  VecX gaps = VecX::Constant(x.size() / 3, std::numeric_limits<double>::quiet_NaN());
  const auto& laws = contact.pairs().laws();
  contact.require_at(x);
  contact.potential().visit_active([&](const ActivePair& pair) {
    const double gap = pair.distance - laws[pair.law].offset();
    for (const int v : pair.vertices) gaps(v) = std::fmin(gaps(v), gap);
  });
  return gaps;
}

}  // namespace tack
