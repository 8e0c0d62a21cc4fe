#include "tests/support/test_run.hpp"

#include "framework/config/bind.hpp"
#include "framework/contact/contact_system.hpp"
#include "geometry/exact/intersections.hpp"

namespace tack {

TestRun::TestRun(const std::string& yaml)
    : simulation(parse_experiment("name: test\n" + yaml, "test.yaml"),
                 [this](const Warning& warning) { warnings.push_back(warning); }),
      stepper((simulation.start(), simulation.stepper())) {
  for (const auto& probe : config.probes) probes.emplace_back(instance_of(*probe))->prepare(*world);
}

TestRun::~TestRun() = default;

std::vector<double> TestRun::sample(size_t probe) { return probes[probe]->sample(*world, state()); }

bool TestRun::intersects() const {
  const ContactSystem& contact = *world->contact;
  return !find_intersections(contact.surface().mesh, state().x, contact.colliding(), 1).empty();
}

}  // namespace tack
