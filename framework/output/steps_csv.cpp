#include "framework/output/steps_csv.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "geometry/errors.hpp"

namespace tack {
namespace {

// Returns the columns of energies and energy flows.
std::vector<std::string> terms_of(const StepReport& report) {
  std::vector<std::string> terms;
  for (const NamedEnergy& energy : report.energies) terms.push_back("energy_" + energy.name);
  EnergyFlows::for_each(report.flows, [&](const std::string& name, double) { terms.push_back(name); });
  return terms;
}

std::vector<std::string> columns_of(const std::vector<std::string>& terms, const StepReport& first) {
  std::vector<std::string> columns = {"step",
                                      "time",
                                      "step_size",
                                      "halvings",
                                      "newton_iterations",
                                      "linear_solves",
                                      "linear_iterations",
                                      "line_search_evaluations",
                                      "contacts",
                                      "candidates",
                                      "min_distance",
                                      "min_gap"};
  columns.insert(columns.end(), terms.begin(), terms.end());
  columns.insert(columns.end(), {"residual", "unbalanced_force", "tolerated_force", "converged", "lag_iterations",
                                 "friction_residual", "wall_seconds"});
  for (const std::string_view phase : phase_names) {
    columns.push_back(fmt::format("seconds_{}", phase));
  }
  for (const char* reason : rejection_names) columns.push_back(fmt::format("rejected_{}", reason));
  if (first.error) columns.insert(columns.end(), {"step_error", "repeats"});
  for (const StepMetric& metric : first.metrics) columns.push_back(metric.name);
  return columns;
}

std::vector<double> row_of(const StepReport& r) {
  std::vector<double> row = {double(r.step),
                             r.time,
                             r.step_size,
                             double(r.rejections.cutbacks()),
                             double(r.solve.iterations),
                             double(r.solve.linear_solves),
                             double(r.solve.linear_iterations),
                             double(r.solve.line_search_evaluations),
                             double(r.contacts),
                             double(r.candidates),
                             r.min_distance,
                             r.min_gap};
  for (const NamedEnergy& energy : r.energies) row.push_back(energy.value);
  EnergyFlows::for_each(r.flows, [&](const std::string&, double energy) { row.push_back(energy); });
  row.insert(row.end(), {r.solve.residual, r.unbalanced_force, r.tolerated_force, r.converged ? 1.0 : 0.0, double(r.lag_iterations),
                         r.friction_residual, r.wall_seconds});
  row.insert(row.end(), r.phases.begin(), r.phases.end());
  row.insert(row.end(), r.rejections.counts.begin(), r.rejections.counts.end());
  if (r.error) row.insert(row.end(), {*r.error, double(r.rejections[Rejection::error])});
  for (const StepMetric& metric : r.metrics) row.push_back(metric.value);
  return row;
}

}  // namespace

StepsCsv StepsCsv::continued(std::filesystem::path path, double last_time) {
  StepsCsv steps(std::move(path));
  if (std::filesystem::exists(steps.path_)) {
    steps.before_ = rows_until(read_csv(steps.path_), last_time, steps.path_.string());
  }
  return steps;
}

void StepsCsv::open(const StepReport& first) {
  terms_ = terms_of(first);
  const std::vector<std::string> columns = columns_of(terms_, first);
  if (!before_.columns.empty() && before_.columns != columns) {
    throw InputError(
        fmt::format("{}: has other columns than this scene writes ({}); resume with "
                    "the scene of that run, or start again",
                    path_.string(), fmt::join(columns, ", ")));
  }
  before_.columns = columns;
  file_.emplace(path_, before_);
  before_ = {};
}

void StepsCsv::add(const StepReport& report) {
  if (!file_) open(report);
  if (terms_of(report) != terms_) {
    throw std::logic_error(
        fmt::format("step {} reports other energies than the first", report.step));
  }
  file_->add(row_of(report));
}

}  // namespace tack
