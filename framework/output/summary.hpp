// Summary of a run: summary.json, and the tables at the end on the terminal.
//
// Keys (numbers that are not finite are null):
//    name, version, commit ("-dirty" is appended if sources differ), status, error, threads, dofs
//    provenance         output/provenance_json.hpp
//    linear_solver, steps, converged_steps, failed_solves, repeated_steps, unconverged_lags
//    step_size          {smallest, largest, mean [s]}, null before the first step
//    wall_seconds [s], phases {phase: seconds}
//    totals             {newton_iterations, linear_solves, linear_iterations,
//                       line_search_evaluations, broad_phase_builds}
//    max_contacts, min_distance [m], min_gap (of different objects) [m], max_unbalanced_force [N],
//    unbalanced_steps, max_affine_strain, lowest_quality, intersections, inverted_tets
//    stepper            step metrics of the stepper: sum or maximum
//    energy             {work_loads, work_script, work_rim, work_healing, dissipated_friction,
//                       dissipated_adhesion, dissipated_plastic, dissipated_damping,
//                       dissipated_areas, dissipated_numerics, flows that terms publish,
//                       at_play [J] (stepping/energy_balance.hpp), causes {areas, integrator,
//                       repeated: {lost, made, sum, in_contact [J]}} (output/energy_losses.hpp),
//                       groups [{objects, at_play, lost, made [J]}] of bodies that do not interact
//                       (stepping/group_balance.hpp), damped_steps, refined_steps, gains}
//    adhesion           [{between, work_of_adhesion [J/m^2], effective [J/m^2], rest_gap [m],
//                       peak_traction [Pa]}]
//    stiffness          {barriers [{between, pairs, stiffness [Pa]}],
//                       affine [{object, objects, stiffness [Pa]}]}
//    meeting_groups     [[object]]
//    remeshings         [{object, step, time [s], quality_before, quality_after, tets_before,
//                       tets_after, lost [J]}], if objects may be remeshed
//    stages             [{protocol, stage, number, begin, end [s], ended_by, value, repeated}], if
//    the
//                       scene has protocols (output/stages_csv.hpp)
//    warnings           [{kind, text, times}]: the first of those that are counted together
//                       (warning.hpp), and their number
//    expect             [{name, value, target, tolerance, at_least, at_most, pass, text}]
#pragma once

#include <array>
#include <filesystem>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "framework/contact/laws/adhesion_summary.hpp"
#include "framework/core/warning.hpp"
#include "framework/output/energy_losses.hpp"
#include "framework/output/expectations.hpp"
#include "framework/output/provenance.hpp"
#include "framework/output/stages_csv.hpp"
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
  std::string error;  // empty: none
  int dofs = 0;
  std::string linear_solver;  // solver and reason; empty for minimisers without one
  int steps = 0;
  int converged_steps = 0;
  // s
  double smallest_step = std::numeric_limits<double>::infinity(), largest_step = 0,
         stepped_time = 0;
  int repeated_steps = 0;    // solves repeated with smaller steps because of their error
  int failed_solves = 0;     // solves rolled back and repeated with half the step
  int unconverged_lags = 0;  // steps whose friction did not reach contact.lagging.until
  double wall_seconds = 0;
  PhaseClock::Seconds phases{};
  long newton_iterations = 0;
  long linear_solves = 0;
  long linear_iterations = 0;  // of iterative solvers
  long line_search_evaluations = 0;
  long broad_phase_builds = 0;
  int max_contacts = 0;
  double min_distance = std::numeric_limits<double>::infinity();  // m
  double min_gap = std::numeric_limits<double>::infinity();       // of different objects [m]
  double max_unbalanced_force = 0;                                // at the end of a step [N]
  // Steps that ended above the tolerated force, because of stagnation without motion.
  int unbalanced_steps = 0;
  double max_affine_strain = 0;  // largest of all affine bodies
  // Lowest mean ratio of a plastically deformed element, relative to its value at rest
  // (checks/flow_quality.hpp); infinity: none.
  double lowest_quality = std::numeric_limits<double>::infinity();
  int intersections = 0;
  int inverted_tets = 0;
  std::map<std::string, double> stepper;  // step metrics (StepMetric)
  EnergyFlows flows;                      // sums [J]
  int damped_steps = 0;  // steps repeated with implicit Euler, because energy would have grown
  // Steps smaller than the scene's, because larger ones gained or lost energy.
  int refined_steps = 0;
  EnergyLosses losses;
  std::vector<std::string> group_names;  // of losses.groups
  int energy_gains = 0;                  // steps with a noticeable numerical energy gain
  std::vector<AdhesionSummary> adhesion;
  UsedStiffness stiffness;
  std::vector<std::vector<std::string>> meeting_groups;  // names of bodies (used_stiffness.hpp)
  std::vector<Remeshing> remeshings;
  std::vector<StageVisit> stages;  // of protocols
  std::vector<WarningCount> warnings;
  std::vector<ExpectationResult> expect;

  // Adds a warning. Returns false if it was counted with an earlier one, also of the resumed run.
  bool add(const Warning& warning);

  // Adds an accepted step: all of its report except wall_seconds and phases, which also cover the
  // time between steps.
  void add(const StepReport& report);
};

// Returns the sums over the steps of a run, with phases; set_totals() restores them.
std::map<std::string, double> totals_of(const RunSummary& summary);
void set_totals(RunSummary& summary, const std::map<std::string, double>& totals);

// Throws InputError if the file cannot be written.
void write_summary(const std::filesystem::path& path, const RunSummary& summary);

// Returns seconds and share of each phase that took time, longest first, as bars, and the total.
std::string phase_table(const RunSummary& summary);

// Returns one line per expectation; "" if there are none.
std::string expect_table(const std::vector<ExpectationResult>& results);

}  // namespace tack
