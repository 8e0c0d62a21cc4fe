// Probes of chambers and of surfaces under a pressure.
#include <fmt/format.h>

#include "framework/config/nearest.hpp"
#include "framework/load/volume_term.hpp"
#include "framework/output/probe.hpp"
#include "framework/world/world.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

const VolumeTerm& chamber_named(const World& world, const std::string& chamber, const std::string& probe) {
  std::vector<std::string> names;
  for (const VolumeTerm* term : world.chambers) {
    if (term->label() == chamber) return *term;
    names.push_back(term->label());
  }
  throw InputError(fmt::format("probe '{}': no chamber or pressure is named '{}'{}", probe, chamber, suggestion(chamber, names, "chambers and pressures")));
}

class Chamber : public Probe {
 public:
  enum class Quantity { pressure, volume, volume_error, amount };
  void fields(Fields& f) override {
    Probe::fields(f);
    f.text("chamber", chamber_, "its name").required();
    f.choice("quantity", quantity_,
             {{"pressure", Quantity::pressure, "what its surface feels, above the ambient pressure [Pa]"},
              {"volume", Quantity::volume, "what it encloses [m^3]"},
              {"volume_error", Quantity::volume_error, "of a liquid: by how much its volume is above that without pressure, as a part of that"},
              {"amount", Quantity::amount, "of gas: what leaks have left, as a part of all"}},
             "what is told of it");
  }
  Unit unit() const override {
    return quantity_ == Quantity::pressure ? units::pressure : quantity_ == Quantity::volume ? units::volume : units::none;
  }
  void prepare(const World& world) override {
    term_ = &chamber_named(world, chamber_, name_);
    const auto refuse = [&](const char* what) { throw InputError(fmt::format("probe '{}': '{}' {}", name_, chamber_, what)); };
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
  std::string chamber_;
  Quantity quantity_ = Quantity::pressure;
  const VolumeTerm* term_ = nullptr;
};

TACK_REGISTER(Probe, Chamber, "chamber", "Pressure and volume of a chamber, or of what a pressure acts on.", "");

}  // namespace
}  // namespace tack
