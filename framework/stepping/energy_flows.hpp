// What became of the energy in one step [J] (energy_balance.hpp).
#pragma once

namespace tack {

struct EnergyFlows {
  double loads = 0, script = 0;                                  // work done from outside
  double rim = 0;  // that of the forces by which covered areas change (contact/rim_term.hpp): within, energy_adhesion falls by it
  double healing = 0;  // what bonds that heal put into what is stored (framework/bond)
  double friction = 0, adhesion = 0, plastic = 0, damping = 0, areas = 0, numerics = 0;  // dissipated
  double jerk = 0;     // by how much the script's work is more with its forces at the end of the step, with which implicit steps begin
  double noise = 0;    // what the solver's tolerance may change it by
  double at_play = 0;  // the most that has moved in the run so far (core/energy_at_play.hpp)
  double moving = 0;   // its kinetic part
  bool in_contact = false;  // whether anything was in contact at its start or end
  bool damped = false;      // done again by the integrator's fallback, because energy would have grown
  bool refined = false;     // smaller than the scene's step, because a larger one made or lost energy
  bool gained = false;      // energy has grown noticeably, and nothing put it in

  // Of what was made of energy, whether areas of contact made more than time integration.
  bool made_by_areas() const { return areas < numerics; }

  EnergyFlows& operator+=(const EnergyFlows& o) {
    loads += o.loads, script += o.script, rim += o.rim, healing += o.healing, friction += o.friction;
    adhesion += o.adhesion, plastic += o.plastic, damping += o.damping;
    areas += o.areas, numerics += o.numerics;
    return *this;
  }
  // Calls act(column, number) for each, in the order of the files.
  template <class Flows, class Act>
  static void for_each(Flows&& flows, const Act& act) {
    act("work_loads", flows.loads);
    act("work_script", flows.script);
    act("work_rim", flows.rim);
    act("work_healing", flows.healing);
    act("dissipated_friction", flows.friction);
    act("dissipated_adhesion", flows.adhesion);
    act("dissipated_plastic", flows.plastic);
    act("dissipated_damping", flows.damping);
    act("dissipated_areas", flows.areas);
    act("dissipated_numerics", flows.numerics);
  }
};

}  // namespace tack
