#include "framework/contact/area_integral/area_integral.hpp"

#include <algorithm>

#include "framework/contact/area_integral/overhang_term.hpp"
#include "framework/contact/area_integral/overlap_boundary_term.hpp"
#include "framework/contact/area_integral/surface_overlap.hpp"
#include "framework/contact/contact_system.hpp"
#include "geometry/distance/point_triangle.hpp"

namespace tack {
namespace {

// Limit of the area ratio of an edge pair, which carries the load of its smaller side: the diagonal
// of a coarse floor (square metres) would stop the edge of a fine mat ten thousand times too hard.
// Not applied to adhering pairs, which must resist the pull of all vertices around an overlap
// boundary.
constexpr double area_ratio_max = 16;

// History array with the key (first vertex of the secondary side, other object).
const std::string sides_name = "contact/integrating_sides";
// Arrays of older states: pairs of objects; per pair of objects, whether the first one integrates.
const std::string coarse_pairs_name = "contact/turned_sides", former_sides_name = "contact/sides";

// The quadrature points and edge pairs that some vertices change.
class LocalSearch : public LocalContact {
 public:
  LocalSearch(NarrowPhase& narrow_phase, const Candidates& candidates, std::span<const int> moved)
      : narrow_phase_(narrow_phase), candidates_(candidates), items_(narrow_phase.touching(candidates, moved)) {}
  const std::vector<int>& vertices() const override { return items_.vertices; }
  void find(const VecX& x, ContactSet& contacts) override { narrow_phase_.find(items_, candidates_, x, contacts); }

 private:
  NarrowPhase& narrow_phase_;
  const Candidates& candidates_;
  LocalItems items_;
};

class AreaIntegralModel : public ContactModel {
 public:
  std::unique_ptr<ContactPotential> make_potential() const override { return std::make_unique<AreaIntegral>(); }
};
TACK_REGISTER(ContactModel, AreaIntegralModel, "area_integral", "Integral of the laws over the overlap of surfaces, with areas lagged from the start of each step.", "");

}  // namespace

std::string AreaIntegral::refusal(ContactFeature, const PairSetup&) const { return ""; }

PairLawIds AreaIntegral::add_laws(const PairSetup&, const PreparedLaws& laws, PairTable& table) {
  PairLaw safety_barrier(laws.offset);
  safety_barrier.add(laws.safety_barrier);
  TangentialLaw of_barrier = laws.tangential;
  of_barrier.mu_a = 0;  // safety-barrier pairs do not adhere
  PairLawIds ids;
  ids.pressure = ids.codimensional = table.add_law(laws.barrier_and_adhesion(), laws.tangential);
  ids.safety_barrier = table.add_law(std::move(safety_barrier), of_barrier);
  return ids;
}

IntegrationRules& AreaIntegral::rules_of(const PairTable& table) {
  if (!rules_) rules_.emplace(table.classes());
  return *rules_;
}

PairRoles AreaIntegral::roles(const PairSetup& pair, const PairTable& table) {
  const auto range = [&](int law) { return table.laws()[law].range(); };
  const double barrier_range = range(pair.laws.safety_barrier);
  PairRole barrier_only{pair.laws.safety_barrier, 1, barrier_range, false};
  barrier_only.region_range_max = pair.region_range;
  PairRoles roles = ContactPotential::roles(pair, table);
  if (!pair.adheres) roles.edge.area_ratio_max = area_ratio_max;
  roles.codimensional.region_range_max = pair.region_range;
  PairRole pressure{pair.laws.pressure, 1, range(pair.laws.pressure), true, pair.laws.safety_barrier, barrier_range};
  pressure.bonds = pair.bonds;
  pressure.region_range_max = pair.region_range;
  IntegrationRule rule;
  rule.carries_pressure = true;
  rule.overlap_only = pair.overlap_only;
  rule.boundary_forces = pair.overlap_only && (!pair.bonds || pair.gap_adhesion);
  rule.overhangs = pair.overlap_only && pair.adheres;
  const bool within_object = pair.a == pair.b;
  rule.by_size = !within_object && pair.side == IntegrationSide::automatic && !rule.overlap_only;
  if (within_object || pair.side == IntegrationSide::both || rule.by_size) pressure.area_factor = 0.5;
  else rule.by_overlap = pair.side == IntegrationSide::automatic, rule.only_if_finer = pair.side == IntegrationSide::finer;
  const bool first_only = !within_object && pair.side == IntegrationSide::first, second_only = !within_object && pair.side == IntegrationSide::second;
  roles.first = second_only ? barrier_only : pressure;
  roles.second = first_only ? barrier_only : pressure;
  // Regions integrate as their objects do.
  rules_of(table).of(pair.a, pair.b) = second_only ? IntegrationRule() : rule;
  rules_of(table).of(pair.b, pair.a) = first_only ? IntegrationRule() : rule;
  return roles;
}

std::unique_ptr<ContactPotential> AreaIntegral::isolated(int a, int b) const {
  auto potential = std::make_unique<AreaIntegral>();
  potential->take_history(*this, a, b);
  return potential;
}

void AreaIntegral::take_history(const AreaIntegral& other, int a, int b) {
  const int last = a == b ? 0 : 1;
  rules_.emplace(ObjectClasses::single(last + 1));
  rules_->of(0, last) = other.rules_->of(a, b);
  rules_->of(last, 0) = other.rules_->of(b, a);
  const IntegrationSides::Pairs& all = other.narrow_phase_->coarse_pairs();
  previous_coarse_pairs_.emplace();
  if (std::binary_search(all.begin(), all.end(), std::pair(a, b))) previous_coarse_pairs_->emplace_back(0, 1);
}

void AreaIntegral::make_terms() {
  ContactPotential::make_terms();
  if (!rules_->any(&IntegrationRule::boundary_forces)) return;
  add_term(std::make_unique<OverlapBoundaryTerm>(*this));
  add_term(std::make_unique<OverhangTerm>(*this));
}

void AreaIntegral::load_history(const History& history) {
  const PairTable& pairs = system().pairs();
  const CollisionMesh& mesh = system().surface().mesh;
  narrow_phase_->set_previous_weights(weights_of(history, mesh));
  previous_coarse_pairs_.reset();
  if (const auto* all = history_values(history, former_sides_name, 1, pairs.objects() * pairs.objects())) {
    previous_coarse_pairs_.emplace();
    for (int a = 0; a < pairs.objects(); ++a)
      for (int b = a + 1; b < pairs.objects(); ++b)
        if (rules_->of(a, b).by_overlap && ((*all)[a * pairs.objects() + b] != 0) != pairs.finer(a, b)) previous_coarse_pairs_->emplace_back(a, b);
  }
  if (const auto turned = history.find(coarse_pairs_name); turned != history.end()) {
    previous_coarse_pairs_.emplace();
    for (int i = 0; i < turned->second.entries(); ++i)
      previous_coarse_pairs_->emplace_back(static_cast<int>(turned->second.values[2 * i]), static_cast<int>(turned->second.values[2 * i + 1]));
  }
  const auto sides = history.find(sides_name);
  if (sides == history.end()) return;
  previous_coarse_pairs_.emplace();
  for (const auto& [vertex, other] : sides->second.keys) {
    const int integrates = mesh.vertex_object[vertex];
    const std::pair<int, int> pair = std::minmax(integrates, other);
    if (rules_->of(pair.first, pair.second).by_overlap && pairs.finer(pair.first, pair.second) != (integrates == pair.first)) previous_coarse_pairs_->push_back(pair);
  }
  std::sort(previous_coarse_pairs_->begin(), previous_coarse_pairs_->end());
}

// Stores only weights towards triangles within range at x: a run that continues from here does not
// know others.
void AreaIntegral::commit(const VecX& x, History& history) const {
  const PairTable& pairs = system().pairs();
  const CollisionMesh& mesh = system().surface().mesh;
  const IntegrationSides::Pairs& coarse_pairs = narrow_phase_->coarse_pairs();
  LaggedWeights weights;
  for (const LaggedWeight& s : narrow_phase_->lagged_weights()) {
    const Triangle& t = mesh.triangles[s.triangle];
    const auto [a, b, c] = corners(x, t);
    const double range = pairs.codimensional(mesh.vertex_object[s.point], mesh.vertex_object[t[0]]).range_max();
    if (point_triangle_distance(vertex(x, s.point), a, b, c) < range * range) weights.push_back(s);
  }
  store_weights(weights, mesh, history);
  history.erase(former_sides_name);
  history.erase(coarse_pairs_name);
  if (!rules_->any(&IntegrationRule::by_overlap)) return;
  HistoryArray& sides = history[sides_name] = {1, {}, {}};
  if (coarse_pairs.empty()) return;
  std::vector<int> first_vertex(pairs.objects(), -1);
  const std::vector<int>& object = mesh.vertex_object;
  for (int v = static_cast<int>(object.size()) - 1; v >= 0; --v) first_vertex[object[v]] = v;
  for (const auto& [a, b] : coarse_pairs) {
    const bool first = !pairs.finer(a, b);
    sides.keys.push_back({first_vertex[first ? a : b], first ? b : a});
  }
  std::sort(sides.keys.begin(), sides.keys.end());
  sides.values.assign(sides.keys.size(), 1);
}

const CollisionMesh& AreaIntegral::mesh() const { return system().surface().mesh; }

void AreaIntegral::clear_caches() {
  LaggedWeights weights = narrow_phase_ ? narrow_phase_->previous_weights() : LaggedWeights();
  narrow_phase_ = std::make_unique<NarrowPhase>(system().surface(), system().pairs(), rules_of(system().pairs()), system().lagged_surface(), system().broad_phase());
  narrow_phase_->set_previous_weights(std::move(weights));
}

void AreaIntegral::begin_step(const VecX&, bool new_candidates) {
  if (new_candidates) narrow_phase_->prepare(system().candidates());
  narrow_phase_->set_previous_coarse_pairs(previous_coarse_pairs_);
  narrow_phase_->keep_sides(kept_sides_);
  narrow_phase_->begin_step(system().candidates());
}

void AreaIntegral::set_candidates(const VecX&) { narrow_phase_->set_candidates(system().candidates()); }

void AreaIntegral::find(const VecX& x, ContactSet& contacts) { narrow_phase_->find(system().candidates(), x, contacts); }

std::unique_ptr<LocalContact> AreaIntegral::local(std::span<const int> moved) {
  return std::make_unique<LocalSearch>(*narrow_phase_, system().candidates(), moved);
}

// Fully overlapping triangles have sites at their three Gauss points, partly overlapping ones at
// their interior quadrature points.
std::vector<OverlapSite> AreaIntegral::overlap_sites(const PairFilter& wanted) const {
  std::vector<OverlapSite> sites;
  const CollisionMesh& mesh = system().surface().mesh;
  const PairTable& pairs = system().pairs();
  for (const OverlapFacets& pair : overlap().facets()) {
    if (!wanted(pair.a, pair.b)) continue;
    const double share = pairs.point(pair.a, pair.b).area_factor;
    for (const OverlapTriangle& t : pair.full_triangles)
      for (int i = 0; i < 3; ++i) {
        Vec3 inside = Vec3::Constant(1.0 / 6);
        inside[i] = 2.0 / 3;
        sites.push_back({t.triangle, inside, pair.b, share * t.area / 3, true});
      }
  }
  for (const InteriorPoint& s : overlap().interior_points()) {
    const int a = mesh.vertex_object[mesh.triangles[s.triangle][0]];
    if (wanted(a, s.object)) sites.push_back({s.triangle, s.inside, s.object, pairs.point(a, s.object).area_factor * s.area, false});
  }
  return sites;
}

}  // namespace tack
