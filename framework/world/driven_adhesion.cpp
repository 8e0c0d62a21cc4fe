#include "framework/world/driven_adhesion.hpp"

#include <algorithm>

namespace tack {
namespace {

// Returns the energy of contact at x (3n) [J], which contact is moved to.
double contact_energy(World& world, const VecX& x) {
  world.participants.move_to(x);
  double sum = 0;
  for (const EnergyRecord& record : world.records.energies())
    if (record.kind == EnergyKind::contact) sum += record.value(x);
  return sum;
}

// Returns what the factors of the present step add to the energy of contact at its start [J].
double environment_work(World& world) {
  const VecX& start = world.drives.step_start();
  const double after = contact_energy(world, start);
  world.drives.exchange_adhesion();
  const double before = contact_energy(world, start);
  world.drives.exchange_adhesion();
  return after - before;
}

}  // namespace

void publish_driven_adhesion(World& world) {
  const std::deque<Drive>& drives = world.drives.all();
  if (std::none_of(drives.begin(), drives.end(), [](const Drive& d) { return d.kind() == FollowerKind::adhesion; })) return;
  FlowRecord record{driven_adhesion, {{"work_environment", FlowKind::fed}}};
  record.amounts = [&world](const VecX& x, double* amounts) {
    amounts[0] = 0;
    if (!world.drives.adhesion_changes()) return;
    amounts[0] = environment_work(world);
    world.participants.move_to(x);
  };
  world.records.add(std::move(record));
}

}  // namespace tack
