#include "framework/load/fluid_cavity_term.hpp"

#include "framework/core/records.hpp"

namespace tack {

std::unique_ptr<VolumeTerm> StoredContent::make_term(std::string label, OrientedSurface surface, const VecX& rest) const {
  return std::make_unique<FluidCavityTerm>(std::move(label), std::move(surface), rest, *this);
}

FluidCavityTerm::FluidCavityTerm(std::string label, OrientedSurface surface, const VecX& rest, const StoredContent& content)
    : VolumeTerm("chamber", std::move(label), std::move(surface)), content_(content), volume_at_rest_(volume(rest)) {}

VolumeSample FluidCavityTerm::sample(double volume, double fraction) const { return content_.at(volume, volume_at_rest_, amount_, time() + fraction * h()); }

double FluidCavityTerm::amount() const { return content_.is_gas() ? amount_ : VolumeTerm::amount(); }

void FluidCavityTerm::load_history(const History& history) {
  const std::vector<double>* stored = history_values(history, label() + "/chamber", 2, 1);
  has_history_ = stored;
  amount_ = stored ? (*stored)[0] : 1;
  stored_time_ = stored ? (*stored)[1] : 0;
}

double FluidCavityTerm::amount_after(const VecX& x) const {
  return content_.after(volume(x), volume_at_rest_, amount_, time() + h(), h(), leak_ ? leak_(x) : 0);
}

void FluidCavityTerm::commit(const VecX& x, History& history) const { history[label() + "/chamber"] = {2, {amount_after(x), time() + h()}, {}}; }

void FluidCavityTerm::flows(const VecX& x, double* amounts) const {
  const double before = volume(start()), now = volume(x), t = time() + h();
  const VolumeSample first = sample(before, 0), last = sample(now, 1);
  const double mean = (first.pressure + 4 * sample((before + now) / 2, 0.5).pressure + last.pressure) / 6;
  amounts[0] = last.energy - first.energy + mean * (now - before);
  amounts[1] = energy(now, amount_, t) - energy(now, amount_after(x), t);
}

void FluidCavityTerm::publish(Records& records) const {
  records.add(EnergyRecord{name(), EnergyKind::of_objects, [this](const VecX& x) { return energy(volume(x), amount_, stored_time()); }});
  records.add(FlowRecord{label(), {{"work_filling", FlowKind::fed}, {"dissipated_leak"}}, [this](const VecX& x, double* amounts) { flows(x, amounts); }});
}

}  // namespace tack
