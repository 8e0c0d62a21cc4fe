#include "energies/viscoelastic/network_history.hpp"

#include <fmt/format.h>

#include <limits>

namespace tack {

NetworkHistory::NetworkHistory(const Body& body, const NetworkFlow& flow)
    : name_(fmt::format("{}/energies/{}/viscous_inverse", body.name, body.energy)), flow_(flow) {}

void NetworkHistory::load_history(const History& history, int samples) {
  if (const auto* values = history_values(history, name_, 9, samples)) {
    inverse_ = *values;
  } else {
    inverse_.assign(9 * static_cast<size_t>(samples), 0.0);
    for (size_t i = 0; i < inverse_.size(); i += 9) inverse_[i] = inverse_[i + 4] = inverse_[i + 8] = 1;
  }
  log_factors_.resize(samples);
  begin_step(0, {});
}

void NetworkHistory::begin_step(double h, const std::vector<double>& slowdowns) {
  if (h == 0) return log_factors_.assign(log_factors_.size(), -std::numeric_limits<double>::infinity());
  const int of_one = slowdowns.empty() ? samples() : samples() / static_cast<int>(slowdowns.size());
  for_each(samples(), [&](int i) { log_factors_[i] = flow_.log_factor(h, slowdowns.empty() ? 1 : slowdowns[i / of_one], inverse(i)); });
}

}  // namespace tack
