#include "tests/support/simulation.hpp"

#include "framework/config/bind.hpp"

namespace tack {

Simulation::Simulation(const std::string& yaml)
    : TestScene(yaml), stepper(*world, config, config.time, *config.solver, clock,
                               [this](const std::string& line) { warnings.push_back(line); }) {
  for (const auto& probe : config.probes) probes.emplace_back(instance_of(*probe))->prepare(*world);
}

Simulation::~Simulation() = default;

std::vector<double> Simulation::sample(size_t probe) { return probes[probe]->sample(*world, state()); }

}  // namespace tack
