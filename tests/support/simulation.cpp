#include "tests/support/simulation.hpp"

namespace tack {

Simulation::Simulation(const std::string& yaml)
    : TestScene(yaml),
      stepper(*world, config, clock, [this](const std::string& line) { warnings.push_back(line); }) {
  for (const auto& probe : config.probes) probe->prepare(*world);
}

Simulation::~Simulation() = default;

std::vector<double> Simulation::sample(size_t probe) { return config.probes[probe]->sample(*world, state()); }

}  // namespace tack
