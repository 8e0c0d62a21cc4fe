#include "framework/compare/comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "geometry/errors.hpp"

namespace tack {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double reference_tolerance_max = 1e-6;  // m/s

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const size_t n = values.size();
  return n % 2 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
}

// A combination that is being measured.
struct Measurement {
  const CompareCase* compare_case;
  const SolverEntry* solver;
  const Reference* reference;
  double reference_step;  // s
  CompareRow row;
  std::vector<double> wall, cpu;

  TrialSettings settings() const { return {solver->solver, row.tolerance, row.time_step, solver->stepper, solver->time}; }
};

std::vector<double> time_steps(const CompareConfig& config, const CompareCase& compare_case) {
  return config.time_steps.empty() ? std::vector<double>{compare_case.step_size} : config.time_steps;
}

const char* name_of(Branch::Kind kind) {
  switch (kind) {
    case Branch::Kind::same: return "same";
    case Branch::Kind::equal: return "equal";
    case Branch::Kind::another: return "another";
  }
  return "";
}

void measure_errors(Measurement& e, const Trial& trial) {
  CompareRow& row = e.row;
  const TrialResult& result = trial.result();
  row.error_rms = row.error_max = row.relative_error = row.energy_gap = nan;
  if (!result.complete || !e.reference->exists()) return;
  Trial& reference = *e.reference->trial;
  const TrialResult& exact = reference.result();
  VecX solution = exact.x;
  if (result.converged && row.time_step == e.reference_step) {
    Branch branch = branch_of(*e.compare_case, *e.reference, row.time_step, result.x);
    row.branch = name_of(branch.kind);
    solution = std::move(branch.x);
  }
  row.error_rms = rms_distance(trial.world(), result.x, solution);
  row.error_max = largest_distance(trial.world(), result.x, solution);
  row.relative_error = row.error_max / e.compare_case->size;
  row.floor = e.reference->floor;
  row.energy_gap = e.compare_case->single() ? reference.potential_at(result.x) - reference.potential_at(exact.x)
                                    : result.energy - exact.energy;
  const auto columns = trial.probe_columns();
  for (size_t i = 0; i < columns.size(); ++i)
    row.probe_errors.emplace_back(columns[i], result.probes[i] - exact.probes[i]);
}

void run_once(Measurement& e, bool first) {
  Trial trial(*e.compare_case, e.settings());
  const TrialResult& result = trial.run();
  e.wall.push_back(result.wall_seconds);
  e.cpu.push_back(result.cpu_seconds);
  if (!first) return;
  CompareRow& row = e.row;
  row.status = result.status;
  row.converged = result.converged;
  row.iterations = result.iterations;
  row.evaluations = result.evaluations;
  row.linear_solves = result.linear_solves;
  row.intersections = result.intersections;
  row.penetration = result.penetration;
  row.crossing_pairs = result.crossing_pairs;
  measure_errors(e, trial);
}

ReferenceRow row_of(const CompareCase& compare_case, const Reference& reference, double h) {
  ReferenceRow row{compare_case.name, h, reference.tolerance, reference.disagreement, reference.floor, compare_case.size, reference.other_branch,
                   compare_case.quasi_static, 0, reference.status};
  if (reference.exists()) row.unknowns = reference.trial->world().dofs.size();
  return row;
}

std::string progress_line(const CompareRow& r) {
  return fmt::format("{} h {:.3g} s: {} at {:.0e} m/s: {} iterations, {:.4g} s, error {:.2e} m{}{}{}", r.problem,
                     r.time_step, r.solver, r.tolerance, r.iterations, r.wall_seconds, r.error_rms,
                     r.below_floor() ? fmt::format(" (noise, below {:.1e} m)", r.floor) : "", r.converged ? "" : ", " + r.status, r.branch == "another" ? ", another branch" : r.inaccurate() ? ", inaccurate" : "");
}

// Records the convergence of each solver with its smallest tolerance, in the problem with most
// iterations.
void record_histories(const CompareConfig& config, std::vector<Measurement>& entries, Comparison& result) {
  const double tightest = *std::min_element(config.tolerances.begin(), config.tolerances.end());
  const Measurement* hardest = nullptr;
  for (const Measurement& e : entries)
    if (e.row.tolerance == tightest && (!hardest || e.row.iterations > hardest->row.iterations)) hardest = &e;
  result.history_of = hardest->compare_case->name;
  for (const Measurement& e : entries) {
    if (e.row.tolerance != tightest || e.compare_case != hardest->compare_case || e.row.time_step != hardest->row.time_step) continue;
    Trial trial(*e.compare_case, e.settings());
    trial.record();
    trial.run();
    result.histories.push_back({e.row.solver, tightest, trial.history()});
  }
}

}  // namespace

void classify_branches(std::vector<CompareRow>& rows) {
  constexpr double closer = 0.5;
  const std::vector<CompareRow> before = rows;
  for (CompareRow& row : rows) {
    if (row.single_step || row.branch != "another") continue;
    for (const CompareRow& other : before) {
      if (other.problem != row.problem || other.solver != row.solver || other.time_step != row.time_step || !other.converged)
        continue;
      const bool tighter = other.tolerance < row.tolerance, looser = other.tolerance > row.tolerance;
      if ((tighter && (other.branch == "same" || other.error_max < closer * row.error_max)) ||
          (looser && row.error_max < closer * other.error_max))
        row.branch = "inaccurate";
    }
  }
}

std::vector<CompareCase> cases_of(const CompareConfig& config) {
  std::vector<CompareCase> cases;
  if (!config.base.empty()) cases.push_back(experiment_case(config.base, config.set, config.steps));
  for (const BaseEntry& base : config.bases) {
    cases.push_back(experiment_case(base.file, base.set, base.steps));
    if (!base.name.empty()) cases.back().name = base.name;
  }
  for (const std::string& path : config.problems) cases.push_back(problem_case(path));
  for (CompareCase& c : cases) c.branch_distance = config.error_limit.value_or(CompareConfig::error_limit_default);
  std::set<std::string> names;
  for (const CompareCase& c : cases)
    if (!names.insert(c.name).second)
      throw InputError(fmt::format("{}: two problems are named '{}'; give the entries of `bases` a `name`", c.path, c.name));
  // Builds each case with every solver and time step, so that errors show before the measurement.
  for (const CompareCase& c : cases) {
    if (config.reference_time_step && !c.single()) c.steps_of(*config.reference_time_step);
    for (const double h : time_steps(config, c)) {
      c.steps_of(h);
      for (const SolverEntry& solver : config.solvers)
        Trial(c, {solver.solver, config.tolerances.front(), solver.own_step().value_or(h), solver.stepper, solver.time});
    }
  }
  return cases;
}

Comparison compare(const CompareConfig& config, const std::vector<CompareCase>& cases,
                   const std::function<void(const std::string&)>& progress) {
  Comparison result;
  std::vector<std::unique_ptr<Reference>> references;
  std::vector<Measurement> entries;
  for (const CompareCase& compare_case : cases) {
    const Reference* common = nullptr;
    for (const double h : time_steps(config, compare_case)) {
      const double h_reference = config.reference_time_step.value_or(h);
      if (!common || !config.reference_time_step) {
        references.push_back(std::make_unique<Reference>(
            make_reference(compare_case, h_reference, config.reference_tolerance, reference_tolerance_max)));
        common = references.back().get();
        result.references.push_back(row_of(compare_case, *common, h_reference));
        progress(common->exists() ? fmt::format("{} h {:.3g} s: reference at {:.0e} m/s, disagreement {:.1e} m",
                                           compare_case.name, h_reference, common->tolerance, common->disagreement)
                             : fmt::format("{}: no reference: {}", compare_case.name, common->status));
      }
      for (const double tolerance : config.tolerances)
        for (const SolverEntry& solver : config.solvers) {
          const std::optional<double> own = solver.own_step();
          if (own && h != time_steps(config, compare_case).front()) continue;
          Measurement e{&compare_case, &solver, common, h_reference, {}, {}, {}};
          e.row.problem = compare_case.name;
          e.row.single_step = compare_case.single();
          e.row.size = compare_case.size;
          e.row.solver = solver.name;
          e.row.tolerance = tolerance;
          e.row.time_step = own.value_or(h);
          if (config.error_limit || e.row.time_step == h_reference) e.row.error_limit = config.error_limit.value_or(CompareConfig::error_limit_default);
          entries.push_back(std::move(e));
        }
    }
  }
  for (int round = 0; round < config.repeat; ++round)
    for (Measurement& e : entries) run_once(e, round == 0);
  for (Measurement& e : entries) {
    const auto [least, most] = std::minmax_element(e.wall.begin(), e.wall.end());
    e.row.wall_seconds = median(e.wall);
    e.row.wall_min = *least;
    e.row.wall_max = *most;
    e.row.wall_spread = *most - *least;
    e.row.cpu_seconds = median(e.cpu);
  }
  record_histories(config, entries, result);
  for (Measurement& e : entries) result.rows.push_back(std::move(e.row));
  classify_branches(result.rows);
  for (const CompareRow& row : result.rows) progress(progress_line(row));
  return result;
}

}  // namespace tack
