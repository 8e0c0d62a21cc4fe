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
constexpr double loosest_reference = 1e-6;  // m/s

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const size_t n = values.size();
  return n % 2 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
}

// A combination that is being measured.
struct Entry {
  const CompareCase* what;
  const SolverEntry* solver;
  const Reference* reference;
  double reference_step;  // s
  CompareRow row;
  std::vector<double> wall, cpu;

  TrialSettings settings() const { return {solver->solver, row.tolerance, row.time_step, solver->stepper, solver->time}; }
};

std::vector<double> time_steps(const CompareConfig& config, const CompareCase& what) {
  return config.time_steps.empty() ? std::vector<double>{what.step_size} : config.time_steps;
}

const char* name_of(Branch::Kind kind) {
  switch (kind) {
    case Branch::Kind::same: return "same";
    case Branch::Kind::equal: return "equal";
    case Branch::Kind::another: return "another";
  }
  return "";
}

void measure_errors(Entry& e, const Trial& trial) {
  CompareRow& row = e.row;
  const TrialResult& found = trial.result();
  row.error_rms = row.error_max = row.relative_error = row.energy_gap = nan;
  if (!found.complete || !e.reference->found()) return;
  Trial& reference = *e.reference->trial;
  const TrialResult& exact = reference.result();
  VecX solution = exact.x;
  if (found.converged && row.time_step == e.reference_step) {
    Branch branch = branch_of(*e.what, *e.reference, row.time_step, found.x);
    row.branch = name_of(branch.kind);
    solution = std::move(branch.x);
  }
  row.error_rms = rms_distance(trial.world(), found.x, solution);
  row.error_max = largest_distance(trial.world(), found.x, solution);
  row.relative_error = row.error_max / e.what->size;
  row.floor = e.reference->floor;
  row.energy_gap = e.what->single() ? reference.potential_at(found.x) - reference.potential_at(exact.x)
                                    : found.energy - exact.energy;
  const auto columns = trial.probe_columns();
  for (size_t i = 0; i < columns.size(); ++i)
    row.probe_errors.emplace_back(columns[i], found.probes[i] - exact.probes[i]);
}

void run_once(Entry& e, bool first) {
  Trial trial(*e.what, e.settings());
  const TrialResult& found = trial.run();
  e.wall.push_back(found.wall_seconds);
  e.cpu.push_back(found.cpu_seconds);
  if (!first) return;
  CompareRow& row = e.row;
  row.status = found.status;
  row.converged = found.converged;
  row.iterations = found.iterations;
  row.evaluations = found.evaluations;
  row.linear_solves = found.linear_solves;
  row.intersections = found.intersections;
  row.penetration = found.penetration;
  row.crossing_pairs = found.crossing_pairs;
  measure_errors(e, trial);
}

ReferenceRow row_of(const CompareCase& what, const Reference& reference, double h) {
  ReferenceRow row{what.name, h, reference.tolerance, reference.disagreement, reference.floor, what.size, reference.other_branch,
                   what.quasi_static, 0, reference.status};
  if (reference.found()) row.unknowns = reference.trial->world().dofs.size();
  return row;
}

std::string line_of(const CompareRow& r) {
  return fmt::format("{} h {:.3g} s: {} at {:.0e} m/s: {} iterations, {:.4g} s, error {:.2e} m{}{}{}", r.problem,
                     r.time_step, r.solver, r.tolerance, r.iterations, r.wall_seconds, r.error_rms,
                     r.noise() ? fmt::format(" (noise, below {:.1e} m)", r.floor) : "", r.converged ? "" : ", " + r.status, r.branch == "another" ? ", another branch" : r.branch == "inaccurate" ? ", not accurate" : "");
}

// Records the convergence of each solver with its smallest tolerance, in the problem with most
// iterations.
void record_histories(const CompareConfig& config, std::vector<Entry>& entries, Comparison& result) {
  const double tightest = *std::min_element(config.tolerances.begin(), config.tolerances.end());
  const Entry* hardest = nullptr;
  for (const Entry& e : entries)
    if (e.row.tolerance == tightest && (!hardest || e.row.iterations > hardest->row.iterations)) hardest = &e;
  result.history_of = hardest->what->name;
  for (const Entry& e : entries) {
    if (e.row.tolerance != tightest || e.what != hardest->what || e.row.time_step != hardest->row.time_step) continue;
    Trial trial(*e.what, e.settings());
    trial.record();
    trial.run();
    result.histories.push_back({e.row.solver, tightest, trial.history()});
  }
}

}  // namespace

void tell_branches_apart(std::vector<CompareRow>& rows) {
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
  std::set<std::string> names;
  for (const CompareCase& c : cases)
    if (!names.insert(c.name).second)
      throw InputError(fmt::format("{}: two of what is compared are called '{}'; give those of `bases` a `name`", c.path, c.name));
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
                   const std::function<void(const std::string&)>& tell) {
  Comparison result;
  std::vector<std::unique_ptr<Reference>> references;
  std::vector<Entry> entries;
  for (const CompareCase& what : cases) {
    const Reference* common = nullptr;
    for (const double h : time_steps(config, what)) {
      const double h_reference = config.reference_time_step.value_or(h);
      if (!common || !config.reference_time_step) {
        references.push_back(std::make_unique<Reference>(
            make_reference(what, h_reference, config.reference_tolerance, loosest_reference)));
        common = references.back().get();
        result.references.push_back(row_of(what, *common, h_reference));
        tell(common->found() ? fmt::format("{} h {:.3g} s: reference at {:.0e} m/s, its two solutions {:.1e} m apart",
                                           what.name, h_reference, common->tolerance, common->disagreement)
                             : fmt::format("{}: no reference: {}", what.name, common->status));
      }
      for (const double tolerance : config.tolerances)
        for (const SolverEntry& solver : config.solvers) {
          const std::optional<double> own = solver.own_step();
          if (own && h != time_steps(config, what).front()) continue;
          Entry e{&what, &solver, common, h_reference, {}, {}, {}};
          e.row.problem = what.name;
          e.row.single_step = what.single();
          e.row.size = what.size;
          e.row.solver = solver.name;
          e.row.tolerance = tolerance;
          e.row.time_step = own.value_or(h);
          entries.push_back(std::move(e));
        }
    }
  }
  for (int round = 0; round < config.repeat; ++round)
    for (Entry& e : entries) run_once(e, round == 0);
  for (Entry& e : entries) {
    const auto [least, most] = std::minmax_element(e.wall.begin(), e.wall.end());
    e.row.wall_seconds = median(e.wall);
    e.row.wall_least = *least;
    e.row.wall_most = *most;
    e.row.wall_spread = *most - *least;
    e.row.cpu_seconds = median(e.cpu);
  }
  record_histories(config, entries, result);
  for (Entry& e : entries) result.rows.push_back(std::move(e.row));
  tell_branches_apart(result.rows);
  for (const CompareRow& row : result.rows) tell(line_of(row));
  return result;
}

}  // namespace tack
