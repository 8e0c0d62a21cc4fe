// Probes of fluid cavities and of surfaces under pressure.
#include <fmt/format.h>

#include "framework/config/nearest.hpp"
#include "framework/load/volume_term.hpp"
#include "framework/output/probe.hpp"
#include "framework/world/world.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

const VolumeTerm& find_cavity(const World& world, const std::string& name, const std::string& probe) {
  std::vector<std::string> names;
  for (const VolumeTerm* term : world.cavities) {
    if (term->label() == name) return *term;
    names.push_back(term->label());
  }
  throw InputError(fmt::format("probe '{}': no chamber or pressure is named '{}'{}", probe, name, suggestion(name, names, "chambers and pressures")));
}

class FluidCavityProbe : public Probe {
 public:
  enum class Quantity { pressure, volume, volume_error, amount };
  void fields(Fields& f) override {
    Probe::fields(f);
    f.text("chamber", cavity_name_, "name of the chamber").required();
    f.choice("quantity", quantity_,
             {{"pressure", Quantity::pressure, "pressure on its surface above ambient [Pa]"},
              {"volume", Quantity::volume, "enclosed volume [m^3]"},
              {"volume_error", Quantity::volume_error, "for a liquid: relative excess of the enclosed volume over the volume at zero pressure"},
              {"amount", Quantity::amount, "for a gas: fraction that leaks have left"}},
             "recorded quantity");
  }
  Unit unit() const override {
    return quantity_ == Quantity::pressure ? units::pressure : quantity_ == Quantity::volume ? units::volume : units::none;
  }
  void prepare(const World& world) override {
    term_ = &find_cavity(world, cavity_name_, name_);
    const auto refuse = [&](const char* what) { throw InputError(fmt::format("probe '{}': '{}' {}", name_, cavity_name_, what)); };
    if (quantity_ == Quantity::volume && !term_->surface().closed()) refuse("is a pressure on a surface that is not closed: it has no volume; ask for its pressure");
    if (quantity_ == Quantity::volume_error && std::isnan(term_->target(0))) refuse("has no volume that it should have: volume_error is of liquids");
    if (quantity_ == Quantity::amount && std::isnan(term_->amount())) refuse("holds no gas: amount is of gases");
  }
  std::vector<double> sample(const World&, const State& state) override {
    switch (quantity_) {
      case Quantity::volume: return {term_->volume(state.x)};
      case Quantity::volume_error: return {term_->volume(state.x) / term_->target(state.time) - 1};
      case Quantity::amount: return {term_->amount()};
      default: return {term_->pressure(state.x, state.time)};
    }
  }

 private:
  std::string cavity_name_;
  Quantity quantity_ = Quantity::pressure;
  const VolumeTerm* term_ = nullptr;
};

TACK_REGISTER(Probe, FluidCavityProbe, "chamber", "Pressure, volume or content of a fluid cavity, or of the surface that a pressure load acts on.", "");

}  // namespace
}  // namespace tack
