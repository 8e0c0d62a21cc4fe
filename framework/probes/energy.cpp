// Probe of energies.
#include <fmt/format.h>

#include "framework/config/nearest.hpp"
#include "framework/output/probe.hpp"
#include "framework/scene/energy_records.hpp"
#include "framework/scene/world.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

class EnergyProbe : public Probe {
 public:
  void fields(Fields& f) override {
    Probe::fields(f);
    f.text("term", term_,
           "total (of all that is stored), kinetic, or another energy_ column of steps.csv without that prefix; or what was "
           "dissipated so far: dissipated_friction (with tangential adhesion), dissipated_plastic, dissipated_damping, and dissipated, their sum");
  }
  void prepare(const World& world) override {
    std::vector<std::string> names = {"total"};
    for (const auto& [name, unused] : dissipated(world.start)) names.push_back(name);
    for (const auto& [name, unused] : energies_by_term(world, world.start)) names.push_back(name);
    if (std::find(names.begin(), names.end(), term_) == names.end())
      throw InputError(fmt::format("probe '{}': no energy term is named '{}'{}", name_, term_,
                                   suggestion(term_, names, "terms")));
  }
  Unit unit() const override { return units::energy; }
  bool asks_for_losses() const override { return term_.starts_with("dissipated"); }
  std::vector<double> sample(const World& world, const State& state) override {
    for (const auto& [name, value] : dissipated(state))
      if (term_ == name) return {value};
    double sum = 0;
    for (const auto& [name, value] : energies_by_term(world, state))
      if (term_ == name || (term_ == "total" && is_stored(name))) sum += value;
    return {sum};
  }

 private:
  static std::array<std::pair<const char*, double>, 4> dissipated(const State& s) {
    const EnergyAccount& e = s.energy;
    return {{{"dissipated", e.friction + e.plastic + e.damping}, {"dissipated_friction", e.friction},
             {"dissipated_plastic", e.plastic}, {"dissipated_damping", e.damping}}};
  }

  std::string term_ = "total";
};

TACK_REGISTER(Probe, EnergyProbe, "energy", "An energy of the whole scene [J].", "");

}  // namespace
}  // namespace tack
