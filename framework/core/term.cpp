#include "framework/core/term.hpp"

#include "framework/core/records.hpp"

namespace tack {

void Term::publish(Records& records) const {
  const EnergyKind stored = dynamic() ? EnergyKind::between_objects : EnergyKind::of_objects;
  records.add(EnergyRecord{name_, stores() ? stored : EnergyKind::of_step, [this](const VecX& x) { return value(x); }});
}

}  // namespace tack
