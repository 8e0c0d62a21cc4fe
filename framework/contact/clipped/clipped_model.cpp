// Contact model `clipped`: as area_integral, but the adhesion of the gap between surfaces is
// integrated over triangles that are clipped at the present positions (clipped_adhesion_term.hpp).
// Contact pressure, bonds, rods and particles are those of area_integral.
#include <algorithm>
#include <optional>

#include "framework/contact/area_integral/area_integral.hpp"
#include "framework/contact/area_integral/surface_overlap.hpp"
#include "framework/contact/clipped/clipped_adhesion_term.hpp"
#include "framework/contact/contact_system.hpp"

namespace tack {
namespace {

ClippedPlanes planes_of(IntegrationSide side) {
  switch (side) {
    case IntegrationSide::first: return ClippedPlanes::of_second;
    case IntegrationSide::second: return ClippedPlanes::of_first;
    case IntegrationSide::finer: return ClippedPlanes::of_coarser;
    case IntegrationSide::both: return ClippedPlanes::of_both;
    default: return ClippedPlanes::of_larger;
  }
}

// Returns whether two laws of the table are the same, friction included: laws without adhesion.
bool press_alike(const PairTable& table, int a, int b) {
  constexpr int gaps = 32;  // over the range
  const PairLaw &first = table.laws()[a], &second = table.laws()[b];
  const TangentialLaw &rubs = table.tangential(a), &rubs_too = table.tangential(b);
  if (first.offset() != second.offset() || first.range() != second.range() || rubs.mu != rubs_too.mu || rubs.mu_static != rubs_too.mu_static || rubs.stribeck != rubs_too.stribeck || rubs.eps_v != rubs_too.eps_v || rubs.elastic_slip != rubs_too.elastic_slip || rubs.across != rubs_too.across) return false;
  for (int i = 1; i <= gaps; ++i) {
    const double distance = first.offset() + (first.range() - first.offset()) * i / gaps;
    if (first.at(distance).slope != second.at(distance).slope) return false;
  }
  return true;
}

class ClippedIntegral : public AreaIntegral {
 public:
  std::string refusal(ContactFeature feature, const PairSetup& pair) const override {
    return feature == ContactFeature::bonds && pair.gap_adhesion && pair.surfaces ? "it clips whole surfaces, while regions of these objects adhere by a law of the gap" : "";
  }

  // Clipped pairs have the barrier alone as pressure. Their contact points have the law of rods and
  // particles, barrier and adhesion, but no pressure.
  PairLawIds add_laws(const PairSetup& pair, const PreparedLaws& laws, PairTable& table) override {
    if (!clips(pair)) return AreaIntegral::add_laws(pair, laws, table);
    PreparedLaws pressure = laws;
    pressure.adhesion = nullptr;
    pressure.tangential.mu_a = 0;
    PairLawIds ids = AreaIntegral::add_laws(pair, pressure, table);
    ids.codimensional = table.add_law(laws.barrier_and_adhesion(), laws.tangential);
    PairLaw alone(laws.offset);
    alone.add(laws.adhesion);
    if (!laws_) laws_.emplace(table.classes());
    ids.other = laws_->add(std::move(alone), ids.codimensional);
    return ids;
  }

  PairRoles roles(const PairSetup& pair, const PairTable& table) override {
    if (!clips(pair)) return AreaIntegral::roles(pair, table);
    const bool both = pair.a == pair.b || pair.side == IntegrationSide::both;
    if (laws_) laws_->set_planes(pair.a, pair.b, both ? ClippedPlanes::of_both : planes_of(pair.side));
    if (laws_ && (pair.region || pair.laws.other >= 0)) set_law(pair, both && pair.laws.other >= 0 ? laws_->half_of(pair.laws.other) : pair.laws.other, table);
    // Regions with laws of pressure of their own are separated by their overlaps.
    const bool regions = std::any_of(pair.all_laws.begin(), pair.all_laws.end(), [&](const PairLawIds& ids) {
      return !press_alike(table, ids.pressure, pair.laws.pressure) || !press_alike(table, ids.safety_barrier, pair.laws.safety_barrier);
    });
    PairSetup of_pressure = pair;
    if (!regions) of_pressure.side = IntegrationSide::automatic;
    of_pressure.overlap_only = pair.overlap_only && regions;
    of_pressure.gap_adhesion = false;
    PairRoles roles = AreaIntegral::roles(of_pressure, table);
    // Both triangles may move by the margin.
    if (pair.laws.other < 0) return roles;
    roles.edge.search_range = laws_->laws()[pair.laws.other].range * (1 + 2 * ClippedLaws::margin_per_range);
    // The contact points of the clipped adhesion, which have the other law, cover the area.
    roles.first.counts_area = roles.second.counts_area = false;
    return roles;
  }

  std::unique_ptr<ContactPotential> isolated(int a, int b) const override {
    auto potential = std::make_unique<ClippedIntegral>();
    potential->take_history(*this, a, b);
    if (laws_) potential->laws_.emplace(laws_->of_objects(a, b));
    return potential;
  }

  ContactPoints points(const ContactPointsRequest& request) const override {
    ContactPoints all = AreaIntegral::points(request);
    if (clipped_) clipped_->add_points(request, static_cast<int>(overlap().interior_points().size()), all);
    return all;
  }

 protected:
  void make_terms() override {
    AreaIntegral::make_terms();
    if (!laws_) return;
    laws_->add_differences();
    auto term = std::make_unique<ClippedAdhesionTerm>(system(), *laws_);
    clipped_ = term.get();
    add_term(std::move(term));
  }

 private:
  static bool clips(const PairSetup& pair) { return pair.surfaces && pair.gap_adhesion; }

  // The roles of a region pair have the next index; within one object, both orders follow.
  void set_law(const PairSetup& pair, int law, const PairTable& table) {
    if (!pair.region) return laws_->set(pair.a, pair.b, law, -1, -1);
    const int next = table.region_pair_count(pair.a, pair.b);
    laws_->set(pair.a, pair.b, law, next, pair.a == pair.b ? next + 1 : table.region_pair_count(pair.b, pair.a));
  }

  std::optional<ClippedLaws> laws_;  // none: no pair is clipped
  const ClippedAdhesionTerm* clipped_ = nullptr;
};

class ClippedModel : public ContactModel {
 public:
  std::unique_ptr<ContactPotential> make_potential() const override { return std::make_unique<ClippedIntegral>(); }
};
TACK_REGISTER(ContactModel, ClippedModel, "clipped",
              "As area_integral, but adhesion of the gap is integrated over triangles clipped by the opposite ones at the present positions: exact areas and boundary forces.", "");

}  // namespace
}  // namespace tack
