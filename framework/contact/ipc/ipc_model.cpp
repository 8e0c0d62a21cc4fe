// Contact model `ipc`: every close pair of primitives counts, as in plain IPC. Weights do not depend
// on what other pairs are close, so that strengths depend on the mesh.
#include "framework/contact/area_integral/area_integral.hpp"

namespace tack {
namespace {

class PairSums : public AreaIntegral {
 public:
  // Pairs count on both sides, whatever `integrate` says.
  std::string refusal(ContactFeature feature, const PairSetup& pair) const override {
    if (feature == ContactFeature::integration_side || feature == ContactFeature::both_sides) return "";
    return ContactPotential::refusal(feature, pair);
  }
  double safety_barrier_range(double) const override { return 1; }

  // Edges have a law of their own, for which probes do not count area.
  PairLawIds add_laws(const PairSetup&, const PreparedLaws& laws, PairTable& table) override {
    table.plain_sums = true;
    PairLawIds ids;
    ids.pressure = ids.codimensional = table.add_law(laws.barrier_and_adhesion(), laws.tangential);
    ids.safety_barrier = table.add_law(laws.barrier_and_adhesion(), laws.tangential);
    return ids;
  }
  PairRoles roles(const PairSetup& pair, const PairTable& table) override { 
    PairRoles roles = ContactPotential::roles(pair, table);
    roles.first.carries_pressure = roles.second.carries_pressure = false;
    return roles;
  }
};

class IpcModel : public ContactModel {
 public:
  std::unique_ptr<ContactPotential> make_potential() const override { return std::make_unique<PairSums>(); }
};
TACK_REGISTER(ContactModel, IpcModel, "ipc", "Sum over all close pairs of primitives; strength depends on the mesh.", "Li et al. 2020");

}  // namespace
}  // namespace tack
