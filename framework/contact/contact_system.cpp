#include "framework/contact/contact_system.hpp"

#include <algorithm>

#include "framework/contact/contact_history.hpp"
#include "framework/contact/narrow_phase.hpp"
#include "framework/contact/pair_radii.hpp"
#include "framework/contact/rest_gaps.hpp"
#include "geometry/broad_phase/broad_phase.hpp"
#include "geometry/distance/point_triangle.hpp"

namespace tack {
namespace {

// Returns the Verlet skin of the candidates [m]: twice the displacement of vertices at which they are
// searched again. A tenth of an edge adds few candidates, as the extents of primitives are larger.
// The largest range holds for all objects, because triangles within it at the start of a step are
// subdivided.
double skin_of(double mean_edge, double range) { return std::clamp(0.1 * mean_edge, 0.5 * range, 2 * range); }

// History array with the key (first vertex of the secondary side, other object).
const std::string sides_name = "contact/integrating_sides";
// Arrays of older states: pairs of objects; per pair of objects, whether the first one integrates.
const std::string coarse_pairs_name = "contact/turned_sides", former_sides_name = "contact/sides";

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

}  // namespace

ContactSystem::ContactSystem(ContactSurface surface, PairTable pairs, CollidingObjects colliding,
                             PhaseClock& clock)
    : surface_(std::move(surface)), pairs_(std::move(pairs)), colliding_(colliding), clock_(clock) {
  for (const PairLaw& law : pairs_.laws()) range_ = std::max(range_, law.range());
  range_ = std::max(range_, pairs_.bond_range());
  for (const auto& [a, b] : pairs_.classes().examples()) range_ = std::max(range_, pairs_.edge(a, b).clipped_range);
  const double mean_edge = mean_edge_of(surface_);
  skin_ = skin_of(mean_edge, range_);
  radii_ = pair_radii(surface_, pairs_);
  surface_.rest_gaps = std::make_shared<RestGaps>(surface_, pairs_);
  search_displacement_max_ = std::max(2 * mean_edge, range_);
  clear_caches();
}

ContactSystem::~ContactSystem() = default;

void ContactSystem::set_free(std::vector<char> free) { narrow_phase_->set_free(std::move(free)); }

void ContactSystem::enable_self_pairs(const std::vector<int>& vertices) { broad_phase_->enable_self_pairs(vertices); }

const IntegrationSides::Pairs& ContactSystem::coarse_pairs() const { return narrow_phase_->coarse_pairs(); }

void ContactSystem::load_history(const History& history) {
  narrow_phase_->set_previous_weights(weights_of(history, surface_.mesh));
  previous_coarse_pairs_.reset();
  if (const auto* all = history_values(history, former_sides_name, 1, pairs_.objects() * pairs_.objects())) {
    previous_coarse_pairs_.emplace();
    for (int a = 0; a < pairs_.objects(); ++a)
      for (int b = a + 1; b < pairs_.objects(); ++b)
        if (pairs_.point(a, b).by_overlap && ((*all)[a * pairs_.objects() + b] != 0) != pairs_.finer(a, b)) previous_coarse_pairs_->emplace_back(a, b);
  }
  if (const auto pairs = history.find(coarse_pairs_name); pairs != history.end()) {
    previous_coarse_pairs_.emplace();
    for (int i = 0; i < pairs->second.entries(); ++i)
      previous_coarse_pairs_->emplace_back(static_cast<int>(pairs->second.values[2 * i]), static_cast<int>(pairs->second.values[2 * i + 1]));
  }
  const auto sides = history.find(sides_name);
  if (sides == history.end()) return;
  previous_coarse_pairs_.emplace();
  for (const auto& [vertex, other] : sides->second.keys) {
    const int integrates = surface_.mesh.vertex_object[vertex];
    const std::pair<int, int> pair = std::minmax(integrates, other);
    if (pairs_.point(pair.first, pair.second).by_overlap && pairs_.finer(pair.first, pair.second) != (integrates == pair.first)) previous_coarse_pairs_->push_back(pair);
  }
  std::sort(previous_coarse_pairs_->begin(), previous_coarse_pairs_->end());
}

// Stores only weights towards triangles within range at x: a run that continues from here does not
// know others.
void ContactSystem::commit(const VecX& x, History& history) const {
  LaggedWeights weights;
  for (const LaggedWeight& s : narrow_phase_->lagged_weights()) {
    const Triangle& t = surface_.mesh.triangles[s.triangle];
    const auto [a, b, c] = corners(x, t);
    const double range = pairs_.codimensional(surface_.mesh.vertex_object[s.point], surface_.mesh.vertex_object[t[0]]).range_max();
    if (point_triangle_distance(vertex(x, s.point), a, b, c) < range * range) weights.push_back(s);
  }
  store_weights(weights, surface_.mesh, history);
  history.erase(former_sides_name);
  history.erase(coarse_pairs_name);
  if (!pairs_.any_by_overlap()) return;
  HistoryArray& sides = history[sides_name] = {1, {}, {}};
  if (coarse_pairs().empty()) return;
  std::vector<int> first_vertex(pairs_.objects(), -1);
  const std::vector<int>& object = surface_.mesh.vertex_object;
  for (int v = static_cast<int>(object.size()) - 1; v >= 0; --v) first_vertex[object[v]] = v;
  for (const auto& [a, b] : coarse_pairs()) {
    const bool first = !pairs_.finer(a, b);
    sides.keys.push_back({first_vertex[first ? a : b], first ? b : a});
  }
  std::sort(sides.keys.begin(), sides.keys.end());
  sides.values.assign(sides.keys.size(), 1);
}

const SurfaceOverlap& ContactSystem::overlap() const { return narrow_phase_->overlap(); }

const LaggedSurface& ContactSystem::lagged_surface() const { return narrow_phase_->lagged_surface(); }

void ContactSystem::triangles_near(const Triangle& t, const Vec3& inside, std::vector<int>& out) const {
  broad_phase_->triangles_near(t, inside, out);
}

const OverlapBoundaryForces& ContactSystem::overlap_boundary_forces() const { return narrow_phase_->overlap_boundary_forces(); }

const Candidates& ContactSystem::candidates() const { return broad_phase_->candidates(); }

int ContactSystem::broad_phase_builds() const { return broad_phase_->builds(); }

void erase_contact_history(History& history) {
  for (const std::string& name : {sides_name, coarse_pairs_name, former_sides_name}) history.erase(name);
  erase_lagged_weights(history);
}

void ContactSystem::clear_caches() {
  contacts_ = {};
  LaggedWeights weights = narrow_phase_ ? narrow_phase_->previous_weights() : LaggedWeights();
  broad_phase_ = std::make_unique<BroadPhase>(surface_.mesh, colliding_);
  narrow_phase_ = std::make_unique<NarrowPhase>(surface_, pairs_, *broad_phase_);
  narrow_phase_->set_previous_weights(std::move(weights));
}

void ContactSystem::begin_step(const StepStart& start) {
  const VecX& x = start.x;
  const bool updated = update_candidates(x, VecX());
  const PhaseScope scope(clock_, Phase::narrow_phase);
  if (updated) narrow_phase_->prepare(candidates());
  narrow_phase_->set_previous_coarse_pairs(previous_coarse_pairs_);
  narrow_phase_->keep_sides(kept_sides_);
  narrow_phase_->begin_step(candidates(), x);
}

void ContactSystem::move_to(const VecX& x) {
  cover(x, VecX());
  const PhaseScope scope(clock_, Phase::narrow_phase);
  narrow_phase_->find(candidates(), x, contacts_);
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
  narrow_phase_->set_candidates(candidates(), x);
}

SmallestGaps ContactSystem::smallest_gaps(const VecX& x) const {
  return tack::smallest_gaps(surface_, pairs_, candidates(), x);
}

}  // namespace tack
