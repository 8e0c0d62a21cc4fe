#include "framework/stepping/energy_balance.hpp"

#include <fmt/format.h>

#include <cmath>

#include "framework/assembly/incremental_potential.hpp"
#include "framework/assembly/term_gradient.hpp"
#include "framework/bond/bond_term.hpp"
#include "framework/contact/friction_term.hpp"
#include "framework/contact/rim_term.hpp"
#include "framework/core/damping_terms.hpp"
#include "framework/core/minimizer.hpp"
#include "framework/scene/energy_records.hpp"

namespace tack {
namespace {

constexpr double tolerated_gain = 0.01;   // of the energy at play
constexpr double tolerated_loss = 0.005;  // of it, in a step
// What has moved little so far may be next to nothing of what is going to: energy that has grown is told early only if it
// is that part of what is at play in as many steps on end.
constexpr double growth = 0.1;
constexpr int growing_steps = 16;

EnergyAccount account_of(const EnergyBalance::Energies& energies) {
  EnergyAccount account;
  account.open = true;
  for (const auto& [term, energy] : energies) {
    if (!is_stored(term)) continue;
    if (term == "kinetic") account.kinetic = energy;
    else if (term == "gravity") account.gravity = energy;
    else if (term == "barrier" || term == "adhesion") account.contact += energy;
    else account.elastic += energy;
  }
  return account;
}

double stored(const EnergyAccount& a) { return a.kinetic + a.gravity + a.elastic + a.contact; }

}  // namespace

// As a rule the potential was evaluated there anyway. Leaves contact at `end`.
double EnergyBalance::contact_at_start(const VecX& start, const VecX& end,
                                       const IncrementalPotential& potential) const {
  if (contact_) return *contact_;
  if (const auto known = potential.first_value(world_.contact_term.get(), start)) return *known;
  world_.contact->move_to(start);
  const double energy = world_.contact_term->value(start);
  world_.contact->move_to(end);
  return energy;
}

// The first step of all: what later ones know from the step before.
void EnergyBalance::open(const State& state) {
  start_.open = true;
  start_.contact = *contact_;
  for (const auto& term : world_.elastic_terms) start_.elastic += term->value(state.x);
  if (world_.bonds) start_.elastic += world_.bonds->value(state.x);
  start_.gradient = VecX::Zero(state.x.size());
  for (const auto& term : world_.elastic_terms) add_term_gradient(*term, state.x, start_.gradient);
  if (world_.contact_term) add_term_gradient(*world_.contact_term, state.x, start_.gradient);
  if (world_.bonds) add_term_gradient(*world_.bonds, state.x, start_.gradient);
  if (world_.rim) world_.rim->add_linear_gradient(start_.gradient);
  add_inertia_and_weight(state, start_.gradient);
}

void EnergyBalance::begin(const State& state, bool to_places) {
  taken_ = {};
  start_ = state.energy;
  contact_.reset();
  if (!world_.contact || (start_.open && start_.contact == 0)) {
    contact_ = 0;
  } else if (to_places || !start_.open) {
    world_.contact->move_to(state.x);
    contact_ = world_.contact_term->value(state.x);
  }
  if (!start_.open) open(state);
  const auto [kinetic, gravity] = energies_of_free_vertices(world_, state);
  released_ = state.energy.open ? kinetic + gravity - start_.kinetic - start_.gravity : 0;
  start_.kinetic = kinetic;
  start_.gravity = gravity;
}

void EnergyBalance::end(const VecX& x) {
  taken_ = {};
  if (world_.friction) {
    taken_.friction = world_.friction->dissipated(x, TangentialPart::friction);
    taken_.adhesion = world_.friction->dissipated(x, TangentialPart::adhesion);
  }
  if (world_.bonds) {
    const BondTerm::Changes changes = world_.bonds->changes(x);
    taken_.adhesion += changes.dissipated;
    taken_.healing = -changes.healed;
  }
  if (world_.rim) taken_.rim = -world_.rim->value(x);
  for (const auto& term : world_.elastic_terms) taken_.plastic += term->dissipated(x);
  for (const auto& term : world_.damping_terms) taken_.damping += term->dissipated(x);
}

double EnergyBalance::load_work(const State& state, const VecX& way, double h) const {
  if (world_.load_term.empty()) return 0;
  const VecX both =
      world_.load_term.forces_at(state.time - h, way.size()) + world_.load_term.forces_at(state.time, way.size());
  double work = 0;
  for (int v = 0; v < world_.dofs.vertex_count(); ++v) {
    if (!world_.dofs.moves(v)) continue;
    work += vertex(both, v).dot(vertex(way, v)) / 2;
  }
  return work;
}

// Vertices that several unknowns move hand their inertia and weight on to held ones, too, and what is held in some
// directions has its own.
void EnergyBalance::add_inertia_and_weight(const State& state, VecX& gradient) const {
  for (const int v : world_.dofs.dependents())
    if (world_.dofs.mixed(v)) vertex(gradient, v) += world_.mass(v) * (vertex(state.a, v) - world_.gravity);
  for (const DofMap::HeldBlock& h : world_.dofs.held_blocks()) {
    const int v = world_.dofs.vertex_of_block(h.block);
    vertex(gradient, v) += world_.mass(v) * (vertex(state.a, v) - world_.gravity);
  }
}

// gradient: of elastic and contact energy at x.
double EnergyBalance::script_work(const VecX& way, const VecX& gradient, const VecX& x) {
  VecX sum = start_.gradient.size() > 0 ? VecX(start_.gradient + gradient) : VecX(2 * gradient), end = gradient;
  VecX drag = world_.friction ? world_.friction->forces(x, TangentialPart::all) : VecX::Zero(way.size());
  for (const auto& term : world_.damping_terms) term->add_mean_forces(x, drag);
  for (VecX* forces : {&sum, &end, &drag}) world_.dofs.collect(*forces);
  double work = 0, at_end = 0;
  const auto add = [&](int v, const Vec3& held_way) {
    work += (vertex(sum, v) / 2 - vertex(drag, v)).dot(held_way);
    at_end += (vertex(end, v) - vertex(drag, v)).dot(held_way);
  };
  for (int v = 0; v < world_.dofs.vertex_count(); ++v)
    if (!world_.dofs.moves(v)) add(v, vertex(way, v));
  for (const DofMap::HeldBlock& h : world_.dofs.held_blocks()) {
    const int v = world_.dofs.vertex_of_block(h.block);
    add(v, h.held * vertex(way, v));
  }
  jerk_ = std::max(0.0, at_end - work);
  return work;
}

EnergyFlows EnergyBalance::close(State& state, const Energies& energies, double h, bool script_moves,
                                 IncrementalPotential& potential) {
  const VecX way = state.x - state.x_before;
  EnergyAccount end = account_of(energies);
  EnergyFlows flows = taken_;
  flows.loads = load_work(state, way, h);
  flows.script = released_;
  jerk_ = 0;
  if (script_moves) {
    end.gradient = potential.gradient_at_all_vertices(state.x);
    if (world_.rim) world_.rim->add_linear_gradient(end.gradient);
    add_inertia_and_weight(state, end.gradient);
    flows.script += script_work(way, end.gradient, state.x);
  }
  const double dissipated = flows.friction + flows.adhesion + flows.plastic + flows.damping;
  end.friction = start_.friction + flows.friction + flows.adhesion;
  end.plastic = start_.plastic + flows.plastic;
  end.damping = start_.damping + flows.damping;
  flows.areas = start_.contact - contact_at_start(state.x_before, state.x, potential);
  const double before = stored(start_) - released_;
  flows.numerics = before + flows.loads + flows.script + flows.healing - dissipated - flows.areas - stored(end);
  end.unexplained = start_.unexplained;
  end.lowest = start_.lowest;
  end.bottom = start_.bottom;
  end.grown_steps = start_.grown_steps;
  end.told = start_.told;
  end.at_play = start_.at_play;
  end.at_play.kinetic = std::max({end.at_play.kinetic, start_.kinetic, end.kinetic});
  end.at_play.dissipated = end.friction + end.plastic + end.damping;
  EnergyAtPlay::move(end.at_play.elastic, end.elastic - start_.elastic);
  EnergyAtPlay::move(end.at_play.contact, end.contact - start_.contact);
  EnergyAtPlay::move(end.at_play.gravity, end.gravity - start_.gravity);
  EnergyAtPlay::move(end.at_play.work, flows.loads + flows.script - released_);
  flows.in_contact = start_.contact != 0 || end.contact != 0;
  flows.jerk = jerk_;
  flows.noise = solver_noise();
  flows.at_play = end.at_play.most();
  flows.moving = end.at_play.kinetic;
  flows.gained = watch(end, flows);
  warn_of_growth(end, state, flows);
  state.energy = std::move(end);
  return flows;
}

// What velocities that are off by the solver's tolerance may change the energy by [J].
double EnergyBalance::solver_noise() const {
  const double off = solver_.velocity_tolerance();
  return world_.mass.sum() * off * off;
}

// Growth counts from the lowest point, so that what was lost before is no credit. A script that starts with a
// jerk acts with the force of the end of the step, and that is no gain.
bool EnergyBalance::watch(EnergyAccount& account, const EnergyFlows& flows) {
  const double lowest = account.lowest;
  account.unexplained -= flows.numerics + flows.areas + jerk_;
  account.lowest = std::min(account.lowest, account.unexplained);
  account.bottom = std::min(account.bottom, account.unexplained);
  // What has just set out has next to nothing that it could lose; and what comes and goes, as Newmark's energy of vibrations does, is not lost.
  lost_ = 2 * start_.kinetic >= flows.at_play && lowest - account.unexplained > tolerated_loss * flows.at_play + flows.noise;
  // What friction and damping took, which is at play as well, is known to first order of the step only.
  if (account.unexplained - account.lowest <= tolerated_gain * flows.at_play + flows.noise) return false;
  account.lowest = account.unexplained;
  return true;
}

void EnergyBalance::warn_of_growth(EnergyAccount& account, const State& state, const EnergyFlows& flows) {
  const double gain = account.unexplained - account.bottom;
  account.grown_steps = gain > growth * flows.at_play + flows.noise ? account.grown_steps + 1 : 0;
  warning_.clear();
  if (account.told || account.grown_steps < growing_steps) return;
  account.told = true;
  warning_ = fmt::format("step {} at t = {:.6g} s: energy has grown by {:.3g} J, {:.2g}% of the most that was at play so far, and "
                         "nothing put it in (steps.csv: {})",
                         state.step, state.time, gain, 100 * gain / flows.at_play,
                         flows.made_by_areas() ? "dissipated_areas" : "dissipated_numerics");
}

}  // namespace tack
