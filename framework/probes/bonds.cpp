// Probes of bonds between two objects: number and intactness.
#include <algorithm>
#include <tuple>

#include "framework/bond/bond_term.hpp"
#include "framework/output/probe.hpp"
#include "framework/probes/vertex_set.hpp"
#include "framework/world/world.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

class BondsProbe : public Probe {
 public:
  enum class Quantity { count, area, intact_area, mean_intensity, least_intensity, opening, slip };

  void fields(Fields& f) override {
    Probe::fields(f);
    between_.fields(f);
    f.choice("quantity", quantity_,
             {{"count", Quantity::count, "number of bonds"},
              {"area", Quantity::area, "their area [m^2]"},
              {"intact_area", Quantity::intact_area, "their area weighted by intensity [m^2]"},
              {"mean_intensity", Quantity::mean_intensity, "mean intensity, 1 if all bonds are intact; 0 without bonds"},
              {"least_intensity", Quantity::least_intensity, "intensity of the weakest bond; 0 without bonds"},
              {"opening", Quantity::opening, "mean normal opening since bonding; 0 without bonds [m]"},
              {"slip", Quantity::slip, "mean tangential slip since bonding; 0 without bonds [m]"}},
             "recorded quantity");
  }
  void prepare(const World& world) override {
    require_contact(world, name_);
    std::tie(a_, b_) = between_.prepare(world, name_);
    if (!world.bonds || !world.bonds->table().bonds(a_, b_))
      throw InputError("probe '" + name_ + "': '" + world.bodies[a_].name + "' and '" + world.bodies[b_].name +
                       "' have no adhesion by bonds; give the pair one (tack list adhesion), or take the probe away");
  }
  Unit unit() const override {
    if (quantity_ == Quantity::area || quantity_ == Quantity::intact_area) return units::area;
    return quantity_ == Quantity::opening || quantity_ == Quantity::slip ? units::length : units::none;
  }
  std::vector<double> sample(const World& world, const State& state) override {
    const BondTerm& bonds = *world.bonds;
    const std::vector<Opening> openings = bonds.openings(state.x);
    double count = 0, area = 0, intact = 0, opened = 0, slipped = 0, least = 1;
    for (int i = 0; i < bonds.list().size(); ++i) {
      const Bond& bond = bonds.list().bonds()[i];
      if (!bond.between(a_, b_)) continue;
      const double intensity = bonds.intensity(i);
      const Opening& o = openings[i];
      ++count;
      area += bond.area;
      intact += bond.area * intensity;
      opened += bond.area * o.d;
      slipped += bond.area * o.u.norm();
      least = std::min(least, intensity);
    }
    const double over = area > 0 ? area : 1;
    switch (quantity_) {
      case Quantity::count: return {count};
      case Quantity::area: return {area};
      case Quantity::intact_area: return {intact};
      case Quantity::mean_intensity: return {intact / over};
      case Quantity::least_intensity: return {count > 0 ? least : 0};
      case Quantity::opening: return {opened / over};
      default: return {slipped / over};
    }
  }

 private:
  ObjectNames between_;
  Quantity quantity_ = Quantity::count;
  int a_ = -1, b_ = -1;
};

TACK_REGISTER(Probe, BondsProbe, "bonds", "Bonds between two objects: number, area, intensity, opening or slip.", "");

}  // namespace
}  // namespace tack
