// Probe of energies.
#include <fmt/format.h>

#include <algorithm>

#include "framework/config/nearest.hpp"
#include "framework/output/probe.hpp"
#include "framework/stepping/energy_flows.hpp"
#include "framework/world/energy_records.hpp"
#include "framework/world/world.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

class EnergyProbe : public Probe {
 public:
  void fields(Fields& f) override {
    Probe::fields(f);
    f.text("term", term_,
           "total (all stored energy), kinetic, or another energy_ column of steps.csv without that prefix; "
           "work_loads, the work of loads so far; dissipated_friction (with tangential adhesion), "
           "dissipated_plastic, dissipated_damping or another dissipated_ quantity that a term publishes; or "
           "dissipated, their sum");
  }
  void prepare(const World& world) override {
    std::vector<std::string> names = {"total", "work_loads"};
    for (const std::string& name : accounts(world)) names.push_back(name);
    for (const NamedEnergy& energy : energies_by_term(world, world.start)) names.push_back(energy.name);
    if (std::find(names.begin(), names.end(), term_) == names.end())
      throw InputError(fmt::format("probe '{}': no energy term is named '{}'{}", name_, term_,
                                   suggestion(term_, names, "terms")));
  }
  Unit unit() const override { return units::energy; }
  bool needs_dissipation() const override { return term_.starts_with("dissipated") || term_ == "work_loads"; }
  std::vector<double> sample(const World& world, const State& state) override {
    if (term_ == "work_loads") return {state.energy.loads};
    if (term_ == "dissipated") return {state.energy.all_dissipated()};
    if (term_.starts_with("dissipated_")) return {state.energy.dissipated_as(term_)};
    const std::vector<NamedEnergy> energies = energies_by_term(world, state);
    if (term_ == "total") return {stored_energy(energies)};
    for (const NamedEnergy& energy : energies)
      if (term_ == energy.name) return {energy.value};
    return {0};
  }

 private:
  static std::vector<std::string> accounts(const World& world) {
    std::vector<std::string> names = {"dissipated"};
    for (const EnergyFlows::Published& flow : EnergyFlows(world.records).published)
      if (!flow.account.empty() && std::find(names.begin(), names.end(), flow.account) == names.end()) names.push_back(flow.account);
    return names;
  }

  std::string term_ = "total";
};

TACK_REGISTER(Probe, EnergyProbe, "energy", "An energy of the whole scene [J].", "");

}  // namespace
}  // namespace tack
