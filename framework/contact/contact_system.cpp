#include "framework/contact/contact_system.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "framework/contact/contact_potential.hpp"
#include "framework/contact/surface/pair_radii.hpp"
#include "framework/contact/surface/rest_gaps.hpp"
#include "framework/contact/stencils/stencil_kinds.hpp"
#include "geometry/broad_phase/broad_phase.hpp"

namespace tack {
namespace {

// Returns the Verlet skin of the candidates [m]: twice the displacement of vertices at which they are
// searched again. A tenth of an edge adds few candidates, as the extents of primitives are larger.
// The largest range holds for all objects, because triangles within it at the start of a step are
// subdivided.
double skin_of(double mean_edge, double range) { return std::clamp(0.1 * mean_edge, 0.5 * range, 2 * range); }

// Returns the mean length of the edges that may move [m]; 0 without any.
double mean_edge_of(const ContactSurface& surface) {
  double length = 0;
  int movable = 0;
  for (const auto& [a, b] : surface.mesh.edges) {
    if (!surface.mesh.vertex_movable[a] && !surface.mesh.vertex_movable[b]) continue;
    length += (vertex(surface.rest, a) - vertex(surface.rest, b)).norm();
    ++movable;
  }
  return length / std::max(movable, 1);
}

// Throws std::logic_error if a model has left out what the terms rely on. order: look at the order of
// the stencils as well, which takes longer.
void require_complete(const ContactSet& set, bool order) {
  constexpr const char* remedy = "call join() of framework/contact/stencils/stencil_search.hpp at the end of find()";
  if (set.mollifier_threshold.size() != set.edge_edge.size())
    throw std::logic_error(fmt::format("the contact model found {} edge-edge stencils and {} mollifier thresholds; {}", set.edge_edge.size(), set.mollifier_threshold.size(), remedy));
  if (!order) return;
  for_each_kind(set, [&](auto, const auto& stencils, const double*) {
    if (!std::ranges::is_sorted(stencils, {}, [](const auto& s) { return s.law; }))
      throw std::logic_error(fmt::format("the contact model found stencils that are not sorted by law; {}", remedy));
  });
}

}  // namespace

ContactSystem::ContactSystem(ContactSurface surface, PairTable pairs, CollidingObjects colliding,
                             PhaseClock& clock, std::unique_ptr<ContactPotential> potential)
    : surface_(std::move(surface)), pairs_(std::move(pairs)), colliding_(colliding), clock_(clock), lagged_(surface_), potential_(std::move(potential)) {
  for (const PairLaw& law : pairs_.laws()) range_ = std::max(range_, law.range());
  range_ = std::max(range_, pairs_.bond_range());
  for (const auto& [a, b] : pairs_.classes().examples()) range_ = std::max(range_, pairs_.edge(a, b).search_range);
  const double mean_edge = mean_edge_of(surface_);
  skin_ = skin_of(mean_edge, range_);
  radii_ = pair_radii(surface_, pairs_);
  if (potential_->uses_rest_gaps()) surface_.rest_gaps = std::make_shared<RestGaps>(surface_, pairs_);
  search_displacement_max_ = std::max(2 * mean_edge, range_);
  broad_phase_ = std::make_unique<BroadPhase>(surface_.mesh, colliding_);
  potential_->attach(*this);
}

ContactSystem::~ContactSystem() = default;

void ContactSystem::set_free(std::vector<char> free) { potential_->set_free(std::move(free)); }


void ContactSystem::load_history(const History& history) { potential_->load_history(history); }

void ContactSystem::commit(const VecX& x, History& history) const { potential_->commit(x, history); }

void ContactSystem::triangles_near(const Triangle& t, const Vec3& inside, std::vector<int>& out) const {
  broad_phase_->triangles_near(t, inside, out);
}

const Candidates& ContactSystem::candidates() const { return broad_phase_->candidates(); }

bool ContactSystem::covers(const VecX& x, std::span<const int> vertices) const { return broad_phase_->covers(x, vertices); }

bool ContactSystem::covers_displaced(int vertex, const Vec3& position) const { return broad_phase_->covers(vertex, position); }

int ContactSystem::broad_phase_builds() const { return broad_phase_->builds(); }

void ContactSystem::clear_caches() {
  contacts_ = {};
  configuration_.resize(0);
  broad_phase_ = std::make_unique<BroadPhase>(surface_.mesh, colliding_);
  lagged_.clear();
  potential_->clear_caches();
}

void ContactSystem::begin_step(const StepStart& start) {
  const bool updated = update_candidates(start.x, VecX());
  const PhaseScope scope(clock_, Phase::narrow_phase);
  lagged_.update(start.x);
  configuration_.resize(0);
  potential_->begin_step(start.x, updated);
}

void ContactSystem::move_to(const VecX& x) {
  cover(x, VecX());
  const PhaseScope scope(clock_, Phase::narrow_phase);
  potential_->find(x, contacts_);
  require_complete(contacts_, checked_version_ != candidates_version_);
  checked_version_ = candidates_version_;
  configuration_ = x;
}

const VecX& ContactSystem::configuration() const {
  if (configuration_.size() == 0) throw std::logic_error("contact has no configuration since the step began: move it to one first (ContactSystem::move_to)");
  return configuration_;
}

void ContactSystem::require_at(const VecX& x) const {
  // Positions that are scattered from unknowns again may differ by rounding errors.
  constexpr double rounding = 1e-12;  // relative, of coordinates
  const bool close = x.size() == configuration_.size() && (x.size() == 0 || (x - configuration_).lpNorm<Eigen::Infinity>() <= rounding * x.lpNorm<Eigen::Infinity>());
  if (!close) throw std::logic_error("contact is asked for at another configuration than its own: move it there first (ContactSystem::move_to), or for a while (ContactSystem::at)");
}

bool ContactSystem::update_candidates(const VecX& x, const VecX& p) {
  const PhaseScope scope(clock_, Phase::broad_phase);
  if (!broad_phase_->update(x, p, radii_, skin_)) return false;
  ++candidates_version_;
  return true;
}

void ContactSystem::cover(const VecX& x, const VecX& p) {
  if (!update_candidates(x, p)) return;
  const PhaseScope scope(clock_, Phase::narrow_phase);
  if (!lagged_.is_set()) lagged_.update(x);
  potential_->set_candidates(x);
}

SmallestGaps ContactSystem::smallest_gaps(const VecX& x) const {
  return tack::smallest_gaps(surface_, pairs_, candidates(), x);
}

}  // namespace tack
