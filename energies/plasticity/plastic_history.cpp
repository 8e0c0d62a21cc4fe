#include "energies/plasticity/plastic_history.hpp"

#include <fmt/format.h>

namespace tack {

PlasticHistory::PlasticHistory(const Body& body) : name_(fmt::format("{}/energies/{}/", body.name, body.energy)) {}

void PlasticHistory::load_history(const History& history, int samples) {
  if (const auto* values = history_values(history, name_ + inverse_name, 9, samples)) {
    inverse_ = *values;
  } else {
    inverse_.assign(9 * static_cast<size_t>(samples), 0.0);
    for (size_t i = 0; i < inverse_.size(); i += 9) inverse_[i] = inverse_[i + 4] = inverse_[i + 8] = 1;
  }
  if (const auto* values = history_values(history, name_ + strain_name, 1, samples)) strain_ = *values;
  else strain_.assign(samples, 0.0);
}

}  // namespace tack
