// tack check: validates an experiment without running it: keys, meshes, pairs, the initial state,
// and the derivatives of the incremental potential there.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "framework/app/commands.hpp"
#include "framework/app/thread_limit.hpp"
#include "framework/checks/bent_solids.hpp"
#include "framework/checks/derivative_check.hpp"
#include "framework/checks/element_warnings.hpp"
#include "framework/checks/flush_faces.hpp"
#include "framework/checks/law_check.hpp"
#include "framework/checks/resolution.hpp"
#include "framework/checks/round_friction.hpp"
#include "framework/checks/scale_warnings.hpp"
#include "framework/contact/contact_potential.hpp"
#include "framework/experiment/built_experiment.hpp"
#include "framework/experiment/retired_key_warnings.hpp"
#include "framework/experiment/time_scales.hpp"
#include "framework/experiment/tolerances.hpp"
#include "framework/output/used_stiffness.hpp"
#include "framework/run/equilibrium_check.hpp"
#include "framework/run/gradient_check.hpp"
#include "framework/run/protocol_run.hpp"
#include "geometry/errors.hpp"
#include "geometry/tets/divide_tets.hpp"

namespace tack {
namespace {

constexpr size_t shown_names_max = 8;  // of a group of bodies

void print_warnings(const std::vector<Warning>& warnings) {
  for (const Warning& warning : warnings) fmt::print("warning: {}\n", warning.text);
}

std::vector<std::string> first_of(const std::vector<std::string>& names) { return {names.begin(), names.begin() + static_cast<long>(std::min(names.size(), shown_names_max))}; }

// Returns "; waves cross it in 2 ms (0.5 steps)"; "" if the body has no such time.
std::string wave_text(const Experiment& experiment, const World& world, int body) {
  const auto time = wave_time(experiment, world, body);
  return time ? fmt::format("; waves cross it in {} ({:.2g} steps)", time_text(*time), *time / experiment.time.step) : "";
}

void print_contents(const Experiment& experiment, const World& world) {
  for (size_t i = 0; i < world.bodies.size(); ++i) {
    const Body& body = world.bodies[i];
    fmt::print("object '{}': {}; {} vertices, {} tets{}, {} surface triangles{}{}\n", body.name, size_text(world, static_cast<int>(i)), body.vertex_count, body.tets.size(),
               body.elements == Elements::composite ? fmt::format(" ({} composite ones)", body.tets.size() / composite_parts) : "", body.triangles.size(),
               body.surface_triangles.empty() ? "" : fmt::format(" ({} in contact)", body.surface_triangles.size()),
               body.movable ? wave_text(experiment, world, static_cast<int>(i)) : ", fixed");
    for (const std::string& line : body.notes) fmt::print("  {}\n", line);
  }
  fmt::print("unknowns: {}\ntime: {}\n", world.dofs.size(), steps_text(experiment));
  if (const auto groups = meeting_names(world); groups.size() > 1)
    for (const auto& names : groups) fmt::print("may come into contact in the run: '{}'{}\n", fmt::join(first_of(names), "', '"), names.size() > shown_names_max ? fmt::format(" and {} more", names.size() - shown_names_max) : "");
  for (const AdhesionSummary& r : world.adhesion)
    fmt::print("adhesion {}: peak {:.6g} Pa, work {:.6g} J/m^2, effective work with the barrier "
               "{:.6g} J/m^2, equilibrium gap {:.4g} m\n",
               r.names(), r.peak_traction, r.work_of_adhesion, r.effective, r.rest_gap);
}

// Formats a relative error: "error 2.1e-09 (resolution 3e-10; 2 of 400 at kinks)". The resolution is
// that of the finite differences.
std::string error_text(const DifferenceStudy& study) {
  if (study.scale == 0) return "zero";
  const std::string kinks =
      study.unclear > 0 ? fmt::format("; {} of {} at kinks", study.unclear, study.components) : "";
  return fmt::format("error {:.1e} (resolution {:.0e}{})", study.error, study.resolution, kinks);
}

// Prints the number of pairs that the contact model finds at the start, where derivatives are checked.
void print_active_contact(World& world) {
  if (!world.contact) return;
  world.contact->move_to(world.start.x);
  fmt::print("contact: {} pairs of primitives act at the start\n", world.contact->potential().active_count());
}

// Prints the derivative checks; returns false if the derivatives of a term contradict its value.
bool print_derivatives(const std::vector<DerivativeCheck>& checks) {
  bool right = true;
  for (const DerivativeCheck& c : checks) {
    if (!c.active()) {
      fmt::print("derivatives of {}: inactive at the start (zero there and nearby), skipped\n", c.term);
      continue;
    }
    fmt::print("derivatives of {}: gradient {}, Hessian {}{}\n", c.term, error_text(c.gradient),
               error_text(c.hessian), c.wrong() ? "  WRONG: they do not match its value; see its derivatives" : "");
    right = right && !c.wrong();
  }
  fmt::print("(beyond the resolution, relative errors of {:.0e} of gradients and {:.0e} of Hessians are let pass)\n", gradient_tolerance, hessian_tolerance);
  return right;
}

constexpr double tolerated_error = 0.01;  // of the largest derivative of a curve

void print_gradient(const GradientCheck& c, const char* where, size_t i) {
  fmt::print("{:<11} {:>12.6g} {:>16.9g} {:>16.9g}   {:.1e}\n", where, c.times[i], c.gradients[i], c.differences[i], c.error(i));
}

int check_gradient_of(const CheckOptions& options) {
  const size_t colon = options.gradient.find(':');
  if (colon == std::string::npos || colon == 0 || colon + 1 == options.gradient.size())
    throw InputError("--gradient: expects PROBE:KEY, as in force:objects.tape.energies.0.young; got '" + options.gradient + "'");
  const std::string probe = options.gradient.substr(0, colon), key = options.gradient.substr(colon + 1);
  const ThreadLimit threads(options.threads);
  const GradientCheck c = check_gradient(loaded_scene(options), probe, key, options.gradient_step);
  fmt::print("d({})/d({}), and finite differences of runs with {:.6g} -+ {:.3g}, all in SI\n", probe, key, c.number, c.step);
  print_warnings(c.warnings);
  if (c.times.empty()) {
    fmt::print("the runs have values at no common time\n");
    return exit_expectation_failed;
  }
  if (c.nothing_to_compare()) {
    fmt::print("nothing to compare: '{}' is {} in the runs with the two values of {}, at all {} times; its largest sensitivity is {:.3g}. Choose a probe that depends on "
               "the key, a run long enough for it, or a larger --gradient-step\n", probe, c.largest_value == 0 ? "zero" : "the same", key, c.times.size(), c.largest_gradient);
    return exit_expectation_failed;
  }
  fmt::print("{:<11} {:>12} {:>16} {:>16}   error, of {:.4g}\n", "", "t [s]", "sensitivity", "difference", c.largest);
  print_gradient(c, "at the end", c.times.size() - 1);
  print_gradient(c, "worst", c.worst);
  fmt::print("median error of {} times: {:.1e}\n", c.times.size(), c.median_error);
  fmt::print("user time relative to a run without sensitivities: {:.2f}\n", c.cost);
  if (c.error(c.worst) <= tolerated_error) return exit_done;
  fmt::print("the error exceeds {:g}: lower the tolerances (solver.tolerance; quasi-static solver.force_tolerance), and check whether the differences change with "
             "--gradient-step\n", tolerated_error);
  return exit_expectation_failed;
}

}  // namespace

int check_command(const CheckOptions& options) {
  if (!options.gradient.empty()) return check_gradient_of(options);
  BuiltExperiment built(loaded_scene(options));
  const Experiment& experiment = built.experiment();
  World& world = built.world();
  if (built.experiment().protocols.empty()) probes_of(built);
  else ProtocolRun{built};
  print_warnings(retired_key_warnings(built.root(), experiment));
  print_contents(experiment, world);
  for (const std::string& line : world.start_notes) fmt::print("{}\n", line);
  for (const std::string& line : BentSolids(experiment, world).notes()) fmt::print("{}\n", line);
  print_warnings(element_warnings(experiment, world));
  print_warnings(scale_warnings(experiment, world));
  print_warnings(resolution_warnings(experiment, world));
  print_warnings(round_friction_warnings(experiment, world));
  print_warnings(flush_face_warnings(experiment, world));
  print_warnings(tolerance_warnings(experiment));
  const LawCheck laws = check_laws(world);
  for (const std::string& line : laws.notes) fmt::print("{}\n", line);
  print_warnings(laws.warnings);
  for (const std::string& line : laws.errors) fmt::print("{}  WRONG: see its formula\n", line);
  const EquilibriumCheck equilibrium = check_equilibrium(experiment, world, built.clock());
  print_warnings(equilibrium.warnings);
  if (!equilibrium.error.empty()) fmt::print("no equilibrium in the first step: {}\n", equilibrium.error);
  const std::vector<DerivativeCheck> derivatives = check_derivatives(world, experiment.time.step, built.clock());
  print_active_contact(world);
  const bool right = print_derivatives(derivatives) && laws.errors.empty() && equilibrium.error.empty();
  if (right) fmt::print("no intersection, no inverted tetrahedron: {} is OK\n", options.file);
  return right ? exit_done : exit_expectation_failed;
}

}  // namespace tack
