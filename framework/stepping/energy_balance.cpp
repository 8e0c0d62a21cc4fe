#include "framework/stepping/energy_balance.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "framework/assembly/incremental_potential.hpp"
#include "framework/contact/contact_system.hpp"
#include "framework/core/minimizer.hpp"
#include "framework/core/term_gradient.hpp"
#include "framework/load/following_load.hpp"
#include "framework/world/driven_adhesion.hpp"
#include "framework/world/energy_records.hpp"

namespace tack {
namespace {

constexpr double gain_max = 0.01;   // of the reference energy
constexpr double loss_max = 0.005;  // of the reference energy, in a step
// Numerical energy gain that is warned of during the run: at least `warned_gain` of the reference
// energy, in `warned_steps` consecutive steps. In fewer steps, the energy that has moved so far may be
// a small fraction of the energy that will move.
constexpr double warned_gain = 0.1;
constexpr int warned_steps = 16;

EnergyAccount account_of(const EnergyBalance::Energies& energies) {
  EnergyAccount account;
  account.open = true;
  for (const NamedEnergy& energy : energies) switch (energy.kind) {
      case EnergyKind::motion: account.kinetic += energy.value; break;
      case EnergyKind::weight: account.gravity += energy.value; break;
      case EnergyKind::contact: account.contact += energy.value; break;
      case EnergyKind::of_objects:
      case EnergyKind::between_objects: account.elastic += energy.value; break;
      case EnergyKind::of_step: break;
    }
  return account;
}

double stored(const EnergyAccount& a) { return a.kinetic + a.gravity + a.elastic + a.contact; }

// Calls act(term, record) for each energy of contact. The records of a term add up to its value, so
// that the term comes once, with a null record. Energies that a stepper has replaced, and those
// left beside them, come record by record, with a null term.
template <class Act>
void for_each_contact(const Records& records, const Act& act) {
  const Term* last = nullptr;
  for (const EnergyRecord& record : records.energies()) {
    if (record.kind != EnergyKind::contact) continue;
    const Term* stored_term = record.term && !records.replaced(*record.term) ? record.term : nullptr;
    if (stored_term && stored_term == last) continue;
    last = stored_term;
    act(stored_term, stored_term ? nullptr : &record);
  }
}

// Returns the sums of ballistic_energies() over all bodies.
std::array<double, 2> all_ballistic_energies(const World& world, const State& state, double h, double tolerance) {
  std::array<double, 2> sums{};
  if (state.v_before.size() != state.v.size()) return sums;
  for (size_t i = 0; i < world.bodies.size(); ++i) {
    const auto [before, after] = ballistic_energies(world, static_cast<int>(i), state, h, tolerance);
    sums[0] += before;
    sums[1] += after;
  }
  return sums;
}

}  // namespace

EnergyBalance::EnergyBalance(World& world, const Minimizer& solver)
    : world_(world), solver_(solver), groups_(world, solver.velocity_tolerance()) {}

// Returns the energy of contact at x [J]; contact must be at x.
double EnergyBalance::contact_at(const VecX& x) const {
  double sum = 0;
  for_each_contact(world_.records, [&](const Term* term, const EnergyRecord* record) { sum += term ? term->value(x) : record->value(x); });
  return sum;
}

// Returns the energy of contact at the start of the step [J], usually known from the first evaluation
// of the potential. Leaves contact at `end`.
double EnergyBalance::contact_at_start(const VecX& start, const VecX& end,
                                       const IncrementalPotential& potential) const {
  if (contact_) return *contact_;
  bool known = true;
  double sum = 0;
  for_each_contact(world_.records, [&](const Term* term, const EnergyRecord*) {
    const auto first = term ? potential.first_value(term, start) : std::nullopt;
    known = known && first;
    sum += first.value_or(0);
  });
  if (known) return sum;
  world_.participants.move_to(start);
  sum = contact_at(start);
  world_.participants.move_to(end);
  return sum;
}

// Adds the gradient of all energies stored in objects and between them, at every vertex. If given,
// `potential` already has most of it.
void EnergyBalance::add_stored_gradient(const VecX& x, VecX& gradient, IncrementalPotential* potential) const {
  const Records& records = world_.records;
  std::vector<const Term*> terms;
  for (const EnergyRecord& r : records.energies())
    if (r.term && is_stored(r.kind) && (terms.empty() || terms.back() != r.term) && !records.replaced(*r.term)) terms.push_back(r.term);
  if (potential && !records.any_replaced()) gradient += potential->gradient_at_all_vertices(x);
  else for (const Term* term : terms) add_stencil_gradient(*term, x, gradient);
  for (const Term* term : terms) term->add_linear_gradient(gradient);
  for (const ForceRecord& r : records.forces()) {
    if (r.term || !r.stored) continue;
    VecX forces = VecX::Zero(x.size());
    r.add(x, "", forces);
    gradient -= forces;
  }
}

// Opens the account of the first state of the run; later steps continue that of the step before.
void EnergyBalance::open_account(const State& state) {
  start_.open = true;
  start_.contact = *contact_;
  for (const EnergyRecord& r : world_.records.energies())
    if (r.kind == EnergyKind::of_objects || r.kind == EnergyKind::between_objects) start_.elastic += r.value(state.x);
  start_.gradient = VecX::Zero(state.x.size());
  add_stored_gradient(state.x, start_.gradient, nullptr);
  add_inertia_and_weight(state, start_.gradient);
}

void EnergyBalance::begin(const State& state, bool has_prescribed_motion) {
  dissipated_ = {};
  start_ = state.energy;
  contact_.reset();
  if (start_.open && start_.contact == 0 && !world_.drives.adhesion_changes()) {
    contact_ = 0;
  } else if (has_prescribed_motion || !start_.open) {
    world_.participants.move_to(state.x);
    contact_ = contact_at(state.x);
  }
  if (!start_.open) open_account(state);
  if (world_.contact && groups_.needs_contact(state)) world_.participants.move_to(state.x);
  groups_.begin(state);
  const auto [kinetic, gravity] = energies_of_free_vertices(world_, state);
  released_ = state.energy.open ? kinetic + gravity - start_.kinetic - start_.gravity : 0;
  start_.kinetic = kinetic;
  start_.gravity = gravity;
}

void EnergyBalance::end(const VecX& x) {
  fed_at_start_ = 0;
  groups_.end(x);
  dissipated_ = EnergyFlows(world_.records);
  for (const auto& load : world_.following_loads)
    if (!load->stores()) dissipated_.loads += load->work(x, world_.dofs);
  std::vector<std::string> written;
  for (const FlowRecord& record : world_.records.flows()) {
    std::vector<double> amounts(record.columns.size());
    record.amounts(x, amounts.data());
    if (record.name == driven_adhesion) fed_at_start_ += std::accumulate(amounts.begin(), amounts.end(), 0.0);
    for (size_t i = 0; i < amounts.size(); ++i) {
      const std::string& column = record.columns[i].name;
      const bool first = std::find(written.begin(), written.end(), column) == written.end();
      if (first) written.push_back(column);
      double& amount = dissipated_.amount(column);
      amount = first ? amounts[i] : amount + amounts[i];
    }
  }
}

double EnergyBalance::load_work(const Stepper::LoadTimes& times, const VecX& displacement) {
  if (world_.load_term.empty()) return 0;
  const VecX both =
      world_.load_term.forces_at(times.from, displacement.size()) + world_.load_term.forces_at(times.to, displacement.size());
  double work = 0;
  for (int v = 0; v < world_.dofs.vertex_count(); ++v) {
    if (!world_.dofs.moves(v)) continue;
    const double of_vertex = vertex(both, v).dot(vertex(displacement, v)) / 2;
    work += of_vertex;
    groups_.add_load_work(v, of_vertex);
  }
  return work;
}

// Adds inertia and weight of vertices that depend on fixed ones, and of partly fixed vertices.
void EnergyBalance::add_inertia_and_weight(const State& state, VecX& gradient) const {
  for (const int v : world_.dofs.dependents())
    if (world_.dofs.mixed(v)) vertex(gradient, v) += world_.mass(v) * (vertex(state.a, v) - world_.gravity);
  for (const DofMap::PartlyFixedBlock& h : world_.dofs.partly_fixed_blocks()) {
    const int v = world_.dofs.vertex_of_block(h.block);
    vertex(gradient, v) += world_.mass(v) * (vertex(state.a, v) - world_.gravity);
  }
}

// Returns the work of the prescribed motion [J]. gradient: of elastic and contact energy at x.
double EnergyBalance::prescribed_work(const VecX& displacement, const VecX& gradient, const VecX& x) {
  VecX sum = start_.gradient.size() > 0 ? VecX(start_.gradient + gradient) : VecX(2 * gradient), end = gradient;
  VecX drag = VecX::Zero(displacement.size());
  for (const ForceRecord& record : world_.records.forces())
    if (!record.stored) record.add(x, "", drag);
  for (VecX* forces : {&sum, &end, &drag}) world_.dofs.move_to_independents(*forces);
  double work = 0, at_end = 0;
  const auto add = [&](int v, const Vec3& fixed_displacement) {
    const double mean = (vertex(sum, v) / 2 - vertex(drag, v)).dot(fixed_displacement), last = (vertex(end, v) - vertex(drag, v)).dot(fixed_displacement);
    work += mean;
    at_end += last;
    groups_.add_prescribed_work(v, mean, last);
  };
  for (int v = 0; v < world_.dofs.vertex_count(); ++v)
    if (!world_.dofs.moves(v)) add(v, vertex(displacement, v));
  for (const DofMap::PartlyFixedBlock& h : world_.dofs.partly_fixed_blocks()) {
    const int v = world_.dofs.vertex_of_block(h.block);
    add(v, h.projection * vertex(displacement, v));
  }
  jerk_ = std::max(0.0, at_end - work);
  return work;
}

EnergyFlows EnergyBalance::close(State& state, const Energies& energies, double h, const Stepper::LoadTimes& load_times,
                                 bool motion_prescribed, IncrementalPotential& potential) {
  const VecX displacement = state.x - state.x_before;
  EnergyAccount end = account_of(energies);
  EnergyFlows flows = dissipated_;
  flows.loads += load_work(load_times, displacement);
  flows.prescribed_motion = released_;
  jerk_ = 0;
  if (motion_prescribed) {
    end.gradient = VecX::Zero(state.x.size());
    add_stored_gradient(state.x, end.gradient, &potential);
    add_inertia_and_weight(state, end.gradient);
    flows.prescribed_motion += prescribed_work(displacement, end.gradient, state.x);
  }
  for (const EnergyFlows::Published& flow : flows.published)
    if (flow.kind == FlowKind::dissipated) end.account(flow.account, start_) += flow.amount;
  flows.areas = start_.contact - contact_at_start(state.x_before, state.x, potential) + fed_at_start_;
  const double before = stored(start_) - released_;
  flows.numerics = before + flows.loads + flows.prescribed_motion + flows.sum(FlowKind::fed) - flows.sum(FlowKind::dissipated) - flows.areas - stored(end);
  end.loads = start_.loads + flows.loads;
  end.numerical_gain = start_.numerical_gain;
  end.numerical_gain_low = start_.numerical_gain_low;
  end.numerical_gain_min = start_.numerical_gain_min;
  end.growing_steps = start_.growing_steps;
  end.growth_warned = start_.growth_warned;
  end.reference_energy = start_.reference_energy;
  end.reference_energy.kinetic = std::max({end.reference_energy.kinetic, start_.kinetic, end.kinetic});
  end.reference_energy.dissipated = end.all_dissipated();
  ReferenceEnergy::move(end.reference_energy.elastic, end.elastic - start_.elastic);
  ReferenceEnergy::move(end.reference_energy.contact, end.contact - start_.contact);
  ReferenceEnergy::move(end.reference_energy.gravity, end.gravity - start_.gravity);
  ReferenceEnergy::move(end.reference_energy.work, flows.loads + flows.prescribed_motion - released_);
  flows.in_contact = start_.contact != 0 || std::any_of(energies.begin(), energies.end(), [](const NamedEnergy& e) {
    return (e.kind == EnergyKind::contact || e.kind == EnergyKind::between_objects) && e.value != 0;
  });
  flows.jerk = jerk_;
  flows.noise = solver_noise();
  const auto [ballistic_before, ballistic] = all_ballistic_energies(world_, state, h, solver_.velocity_tolerance());
  flows.moving = std::max(start_.kinetic - ballistic_before, end.kinetic - ballistic);
  ReferenceEnergy concerned = end.reference_energy;
  concerned.kinetic = flows.moving;
  flows.reference_energy = concerned.largest();
  flows.groups = groups_.close(state, h);
  end.groups = state.energy.groups;
  track_gain(end, flows);
  warn_of_growth(end, state, flows);
  state.energy = std::move(end);
  return flows;
}

// Returns the change of the energy by velocity errors of the tolerance of the solver [J].
double EnergyBalance::solver_noise() const {
  const double error = solver_.velocity_tolerance();
  return world_.mass.sum() * error * error;
}

// Finds out whether the step has a noticeable numerical energy gain or loss. Gains count from the lowest energy
// so far, so that earlier losses do not hide them. A prescribed motion that starts with a jerk acts
// with the force at the end of the step, which is no numerical gain.
void EnergyBalance::track_gain(EnergyAccount& account, EnergyFlows& flows) const {
  const double lowest = account.numerical_gain_low;
  account.numerical_gain -= flows.numerics + flows.areas + jerk_;
  account.numerical_gain_low = std::min(account.numerical_gain_low, account.numerical_gain);
  account.numerical_gain_min = std::min(account.numerical_gain_min, account.numerical_gain);
  // Losses count if half of the reference energy is kinetic. A loss that a later gain compensates, as
  // in vibrations with Newmark, is none.
  const double reference_energy = account.reference_energy.largest();
  flows.lost = 2 * start_.kinetic >= reference_energy && lowest - account.numerical_gain > loss_max * reference_energy + flows.noise;
  // Dissipation by friction and damping, a part of the reference energy, is known to first order
  // only.
  flows.gained = account.numerical_gain - account.numerical_gain_low > gain_max * reference_energy + flows.noise;
  if (flows.gained) account.numerical_gain_low = account.numerical_gain;
}

void EnergyBalance::warn_of_growth(EnergyAccount& account, const State& state, const EnergyFlows& flows) {
  const double gain = account.numerical_gain - account.numerical_gain_min, reference_energy = account.reference_energy.largest();
  account.growing_steps = gain > warned_gain * reference_energy + flows.noise ? account.growing_steps + 1 : 0;
  warning_.clear();
  if (account.growth_warned || account.growing_steps < warned_steps) return;
  account.growth_warned = true;
  warning_ = fmt::format("step {} at t = {:.6g} s: energy has grown by {:.3g} J, {:.2g}% of the reference energy so far, "
                         "without a source (steps.csv: {})",
                         state.step, state.time, gain, 100 * gain / reference_energy,
                         flows.gained_by_areas() ? "dissipated_areas" : "dissipated_numerics");
}

}  // namespace tack
