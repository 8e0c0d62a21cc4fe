// Contact model `clipped`: as area_integral, but the adhesion of the gap between the surfaces of two
// objects is integrated over triangles that are clipped at the present positions
// (clipped_adhesion_term.hpp). Contact pressure, and all other pairs, are those of area_integral.
#include <optional>

#include "framework/contact/area_integral/area_integral.hpp"
#include "framework/contact/clipped/clipped_adhesion_term.hpp"
#include "framework/contact/contact_system.hpp"

namespace tack {
namespace {

ClippedPlanes planes_of(IntegrationSide side) {
  switch (side) {
    case IntegrationSide::first: return ClippedPlanes::of_second;
    case IntegrationSide::second: return ClippedPlanes::of_first;
    case IntegrationSide::finer: return ClippedPlanes::of_coarser;
    default: return ClippedPlanes::of_larger;
  }
}

class ClippedIntegral : public AreaIntegral {
 public:
  std::string refusal(ContactFeature feature, const PairSetup& pair) const override {
    if (!clips(pair)) return "";
    switch (feature) {
      case ContactFeature::tangential_adhesion: return "it has no areas of contact points";
      case ContactFeature::regions: return "it clips the surfaces of whole objects";
      case ContactFeature::both_sides: return "it takes the planes of one side";
      default: return "";
    }
  }

  // Clipped pairs have the barrier alone as pressure.
  PairLawIds add_laws(const PairSetup& pair, const PreparedLaws& laws, PairTable& table) override {
    if (!clips(pair) || pair.region) return AreaIntegral::add_laws(pair, laws, table);
    PreparedLaws pressure = laws;
    pressure.adhesion = nullptr;
    PairLawIds ids = AreaIntegral::add_laws(pair, pressure, table);
    ids.codimensional = table.add_law(laws.barrier_and_adhesion(), laws.tangential);
    PairLaw alone(laws.offset);
    alone.add(laws.adhesion);
    if (!laws_) laws_.emplace(table.classes());
    ids.other = laws_->add(std::move(alone));
    return ids;
  }

  PairRoles roles(const PairSetup& pair, const PairTable& table) override {
    if (pair.laws.other < 0) return AreaIntegral::roles(pair, table);
    laws_->set(pair.a, pair.b, pair.laws.other, planes_of(pair.side));
    PairSetup of_pressure = pair;
    of_pressure.side = IntegrationSide::automatic;
    of_pressure.overlap_only = of_pressure.gap_adhesion = false;
    PairRoles roles = AreaIntegral::roles(of_pressure, table);
    roles.edge.clipped_range = laws_->laws()[pair.laws.other].range;
    return roles;
  }

 protected:
  void make_terms() override {
    AreaIntegral::make_terms();
    if (laws_) add_term(std::make_unique<ClippedAdhesionTerm>(system(), *laws_));
  }

 private:
  static bool clips(const PairSetup& pair) { return pair.a != pair.b && pair.surfaces && pair.gap_adhesion; }

  std::optional<ClippedLaws> laws_;  // none: no pair is clipped
};

class ClippedModel : public ContactModel {
 public:
  std::unique_ptr<ContactPotential> make_potential() const override { return std::make_unique<ClippedIntegral>(); }
};
TACK_REGISTER(ContactModel, ClippedModel, "clipped",
              "As area_integral, but adhesion of the gap is integrated over triangles clipped by the opposite ones at the present positions: exact areas and boundary forces, "
              "at three to five times the cost of an evaluation.", "");

}  // namespace
}  // namespace tack
