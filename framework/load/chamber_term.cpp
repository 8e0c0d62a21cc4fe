#include "framework/load/chamber_term.hpp"

#include "framework/core/records.hpp"

namespace tack {

std::unique_ptr<VolumeTerm> StoredFilling::make_term(std::string label, OrientedSurface surface, const VecX& rest) const {
  return std::make_unique<ChamberTerm>(std::move(label), std::move(surface), rest, *this);
}

ChamberTerm::ChamberTerm(std::string label, OrientedSurface surface, const VecX& rest, const StoredFilling& filling)
    : VolumeTerm("chamber", std::move(label), std::move(surface)), filling_(filling), at_rest_(volume(rest)) {}

VolumeSample ChamberTerm::sample(double volume, double part) const { return filling_.at(volume, at_rest_, amount_, time() + part * h()); }

double ChamberTerm::amount() const { return filling_.is_gas() ? amount_ : VolumeTerm::amount(); }

void ChamberTerm::load_history(const History& history) {
  const std::vector<double>* kept = history_values(history, label() + "/chamber", 2, 1);
  remembers_ = kept;
  amount_ = kept ? (*kept)[0] : 1;
  kept_ = kept ? (*kept)[1] : 0;
}

double ChamberTerm::amount_after(const VecX& x) const {
  return filling_.after(volume(x), at_rest_, amount_, time() + h(), h(), vent_ ? vent_(x) : 0);
}

void ChamberTerm::commit(const VecX& x, History& history) const { history[label() + "/chamber"] = {2, {amount_after(x), time() + h()}, {}}; }

void ChamberTerm::flows(const VecX& x, double* amounts) const {
  const double before = volume(start()), now = volume(x), t = time() + h();
  const VolumeSample first = sample(before, 0), last = sample(now, 1);
  const double mean = (first.pressure + 4 * sample((before + now) / 2, 0.5).pressure + last.pressure) / 6;
  amounts[0] = last.energy - first.energy + mean * (now - before);
  amounts[1] = energy(now, amount_, t) - energy(now, amount_after(x), t);
}

void ChamberTerm::publish(Records& records) const {
  records.add(EnergyRecord{name(), EnergyKind::of_objects, [this](const VecX& x) { return energy(volume(x), amount_, kept_time()); }});
  records.add(FlowRecord{label(), {{"work_filling", FlowKind::fed}, {"dissipated_leak"}}, [this](const VecX& x, double* amounts) { flows(x, amounts); }});
}

}  // namespace tack
