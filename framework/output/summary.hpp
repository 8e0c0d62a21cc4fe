// What remains of a run in one place: summary.json, and the tables at the end on the terminal.
//
// Keys: name, version, commit ("-dirty" behind it if the sources are others), provenance {...} (output/provenance_json.hpp), status, error, threads, dofs, linear_solver, steps, step_size {smallest, largest, mean [s]} (null before the first), converged_steps, failed_solves, repeated_steps,
// unconverged_lags, wall_seconds [s], phases {phase: seconds}, totals {newton_iterations, linear_solves, linear_iterations,
// line_search_evaluations, broad_phase_builds}, max_contacts, min_distance, min_gap (of different objects) [m], max_unbalanced_force [N], unbalanced_steps, max_affine_strain, lowest_quality, intersections,
// inverted_tets, stepper {what it tells of its steps beside all that: the sum or the most}, energy {work_loads, work_script, work_rim, work_healing, dissipated_friction, dissipated_adhesion, dissipated_plastic, dissipated_damping, dissipated_areas,
// dissipated_numerics, and what else terms publish, at_play [J] (stepping/energy_balance.hpp), causes {areas, integrator, repeated: {lost, made, sum, in_contact [J]}} (output/energy_losses.hpp),
// groups [{objects, at_play, lost, made [J]}] (of bodies that have nothing to do with each other: stepping/group_balance.hpp), damped_steps, refined_steps, gains}, adhesion [{between, work_of_adhesion [J/m^2], effective [J/m^2], rest_gap [m],
// peak_traction [Pa]}], stiffness {barriers [{between, pairs, stiffness [Pa]}], affine [{object,
// objects, stiffness [Pa]}]}, meeting_groups [[object]], remeshings [{object, step, time [s], quality_before, quality_after,
// tets_before, tets_after, lost [J]}] (where objects may be meshed anew), warnings [{text, times}]
// (the first of a kind, and how often there was one), expect [{name, value, target, tolerance,
// at_least, at_most, pass, text}]. Numbers that are not finite are null.
#pragma once

#include <array>
#include <filesystem>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "framework/contact/adhesion_summary.hpp"
#include "framework/core/warning.hpp"
#include "framework/output/energy_losses.hpp"
#include "framework/output/expectations.hpp"
#include "framework/output/provenance.hpp"
#include "framework/output/used_stiffness.hpp"
#include "framework/remesh/remeshing.hpp"
#include "framework/stepping/step_report.hpp"

namespace tack {

enum class RunStatus { done, expectation_failed, simulation_failed, interrupted };
std::string_view to_string(RunStatus status);  // "done", "expectation failed", ...

struct RunSummary {
  std::string name;
  Provenance provenance;
  RunStatus status = RunStatus::done;
  std::string error;  // empty if there was none
  int dofs = 0;
  std::string linear_solver;  // what it is and why; empty for minimisers without one
  int steps = 0;
  int converged_steps = 0;
  double smallest_step = std::numeric_limits<double>::infinity(), largest_step = 0, stepped_time = 0;  // s
  int repeated_steps = 0;  // solves that were repeated with smaller steps because of their error
  int failed_solves = 0;  // solves that were rolled back and repeated with half the step
  int unconverged_lags = 0;  // steps in which friction did not reach contact.lagging.until
  double wall_seconds = 0;
  PhaseClock::Seconds phases{};
  long newton_iterations = 0;
  long linear_solves = 0;
  long linear_iterations = 0;  // of solvers that iterate
  long line_search_evaluations = 0;
  long broad_phase_builds = 0;
  int max_contacts = 0;
  double min_distance = std::numeric_limits<double>::infinity();  // m
  double min_gap = std::numeric_limits<double>::infinity();       // of different objects [m]
  double max_unbalanced_force = 0;  // at the end of a step [N]
  int unbalanced_steps = 0;         // that ended with more than is tolerated, because it crawled where nothing moved
  double max_affine_strain = 0;     // of any affine body
  // The lowest mean ratio of an element that flowed, over what it had at rest (checks/flow_quality.hpp); infinity: none flowed.
  double lowest_quality = std::numeric_limits<double>::infinity();
  int intersections = 0;
  int inverted_tets = 0;
  std::map<std::string, double> stepper;  // StepFigure
  EnergyFlows flows;     // sums [J]
  int damped_steps = 0;  // that implicit Euler did again, because energy would have grown
  int refined_steps = 0; // that are smaller than the scene's, because larger ones made or lost energy
  EnergyLosses losses;
  std::vector<std::string> group_names;  // of losses.groups
  int energy_gains = 0;  // steps in which energy had grown noticeably, and nothing put it in
  std::vector<AdhesionSummary> adhesion;
  UsedStiffness stiffness;
  std::vector<std::vector<std::string>> meeting_groups;  // names of bodies (used_stiffness.hpp)
  std::vector<Remeshing> remeshings;
  std::vector<WarningCount> warnings;
  std::vector<ExpectationResult> expect;

  // Whether it is the first of its kind, or of its text. One that is of no kind and was told before, by the run that is gone
  // on with, is the same one.
  bool add(const Warning& warning);

  // Counts an accepted step in: everything a step report tells, but not wall_seconds and phases,
  // which also cover what happens between steps.
  void add(const StepReport& report);
};

// What adds up over the steps of a run, its phases included, and back.
std::map<std::string, double> totals_of(const RunSummary& summary);
void set_totals(RunSummary& summary, const std::map<std::string, double>& totals);

// Throws InputError when the file cannot be written.
void write_summary(const std::filesystem::path& path, const RunSummary& summary);

// Seconds and share of each phase that took time, longest first, as bars; ends with the total.
std::string phase_table(const RunSummary& summary);

// One line per expectation; "" without any.
std::string expect_table(const std::vector<ExpectationResult>& results);

}  // namespace tack
