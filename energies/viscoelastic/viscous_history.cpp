#include "energies/viscoelastic/viscous_history.hpp"

#include <fmt/format.h>

namespace tack {

ViscousHistory::ViscousHistory(const Body& body, const MaxwellParameters& parameters)
    : name_(fmt::format("{}/energies/{}/viscous_inverse", body.name, body.energy)), parameters_(parameters) {}

void ViscousHistory::load_history(const History& history, int samples) {
  if (const auto* values = history_values(history, name_, 9, samples)) {
    committed_ = *values;
  } else {
    committed_.assign(9 * static_cast<size_t>(samples), 0.0);
    for (size_t i = 0; i < committed_.size(); i += 9) committed_[i] = committed_[i + 4] = committed_[i + 8] = 1;
  }
  rewind();
}

}  // namespace tack
