#include "framework/contact/contact_system.hpp"

#include <algorithm>

namespace tack {
namespace {

// The skin, in ranges: how far vertices may move before candidates are searched anew.
constexpr double skin_in_ranges = 0.5;

}  // namespace

ContactSystem::ContactSystem(ContactSurface surface, PairTable pairs, ObjectPairFilter filter,
                             PhaseClock& clock)
    : surface_(std::move(surface)), pairs_(std::move(pairs)), filter_(filter), clock_(clock) {
  for (const PairLaw& law : pairs_.laws()) range_ = std::max(range_, law.range());
  for (int a = 0; a < pairs_.objects(); ++a)
    for (int b = a; b < pairs_.objects(); ++b)
      edge_range_ = std::max(edge_range_, pairs_.edge(a, b).range);
  broad_phase_ = std::make_unique<BroadPhase>(surface_.mesh, filter_);
  narrow_phase_ = std::make_unique<NarrowPhase>(surface_, pairs_);
}

void ContactSystem::begin_step(const VecX& x) {
  cover(x, VecX());
  const PhaseScope scope(clock_, Phase::narrow_phase);
  narrow_phase_->begin_step(candidates(), x);
}

void ContactSystem::move_to(const VecX& x) {
  cover(x, VecX());
  const PhaseScope scope(clock_, Phase::narrow_phase);
  narrow_phase_->find(candidates(), x, contacts_);
}

void ContactSystem::cover(const VecX& x, const VecX& p) {
  const PhaseScope scope(clock_, Phase::broad_phase);
  if (broad_phase_->update(x, p, range_, edge_range_, skin_in_ranges * range_))
    narrow_phase_->set_candidates(candidates(), x);
}

double ContactSystem::smallest_distance(const VecX& x) const {
  return tack::smallest_distance(surface_.mesh, candidates(), x);
}

}  // namespace tack
