#include "framework/compare/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tack {
namespace {

// Escapes a text for a Markdown table: a bar ends the cell, a line break the table, and < begins a
// tag.
std::string cell(const std::string& text) {
  std::string out;
  for (const char c : text) {
    const bool control = static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
    if (c == '|' || c == '<' || c == '`' || c == '\\') out += '\\';
    out += control ? ' ' : c;
  }
  return out;
}

std::string header(const CompareConfig& config, const Provenance& p, double wall_seconds) {
  return fmt::format("# {}\n\n{}\n\nMeasured with tack {} ({}; {}, {}) on {} ({}), {} threads, from {}, by `{}`. Times are medians of {} repetitions, "
                     "interleaved; each measurement has its own world, and loading is not timed. {:.0f} s in total.{} Times depend "
                     "on the machine and its load: compare them within this table.\n",
                     cell(config.name), config.about, p.build.version, p.build.sources(), p.build.compiler, p.build.flags,
                     p.machine.host, p.machine.description(), p.threads, p.date, p.command_line, config.repeat, wall_seconds,
                     config.repeat < 2 ? " One repetition does not show how much times vary." : "");
}

std::string references(const Comparison& c) {
  std::string out = "\n## References\n\nProjected Newton (clamped) to the tolerance shown. *Disagreement*: the largest distance to "
                    "a second solution with absolute projection and CHOLMOD. *Noise floor*: the RMS distance of the two solutions; in a single step, that of the "
                    "second solution to its own minimum. Errors below the floor are noise.\n\n"
                    "| problem | h [s] | unknowns | size [m] | tolerance [m/s] | disagreement [m] | noise floor [m] | |\n| --- | --- | --- | --- | --- | --- | --- | --- |\n";
  for (const ReferenceRow& r : c.references) {
    std::string remark = r.other_branch ? "**the two are different solutions**" : "";
    if (r.tolerance == 0) remark = "**none: " + cell(r.status) + "**";
    else if (std::isnan(r.floor)) remark = "**the second solution failed: the noise floor is unknown**";
    if (r.quasi_static) remark += " quasi-static: converges by `force_tolerance`";
    out += fmt::format("| {} | {:g} | {} | {:.3g} | {:.0e} | {:.1e} | {:.1e} | {} |\n", cell(r.problem), r.time_step, r.unknowns,
                       r.size, r.tolerance, r.disagreement, r.floor, remark);
  }
  return out;
}

// Returns the fastest row of a problem with a known error of at most `level` (RMS, m); nullptr if
// there is none.
const CompareRow* fastest(const Comparison& c, const ReferenceRow& of, double level) {
  const CompareRow* best = nullptr;
  for (const CompareRow& r : c.rows)
    if (r.problem == of.problem && r.solved() && r.known_error() <= level && (!best || r.wall_seconds < best->wall_seconds))
      best = &r;
  return best;
}

// Names the other solvers of a problem that reach `level` as fast as `best`, up to the spread of
// the repetitions.
std::string equally_fast(const Comparison& c, const CompareRow& best, double level) {
  std::vector<std::string> names;
  for (const CompareRow& r : c.rows)
    if (r.problem == best.problem && r.solver != best.solver && r.solved() && r.known_error() <= level && as_fast(r, best) &&
        std::find(names.begin(), names.end(), r.solver) == names.end())
      names.push_back(r.solver);
  return fmt::format("{}", fmt::join(names, ", "));
}

// Returns the table of all tasks (problem, tolerance, time step) together, a row for each solver.
std::string joint_table(const CompareConfig& config, const Comparison& c) {
  struct Sum {
    std::string solver;
    int tasks = 0, solved = 0, fastest = 0, elsewhere = 0, inaccurate = 0, with_error = 0;
    long iterations = 0;
    double log_ratio = 0, log_error = 0;
  };
  std::vector<Sum> sums;
  int tasks = 0, unsolved = 0;
  for (const CompareRow& r : c.rows) {
    auto at = std::find_if(sums.begin(), sums.end(), [&](const Sum& s) { return s.solver == r.solver; });
    if (at == sums.end()) at = sums.insert(sums.end(), {r.solver, 0, 0, 0, 0, 0, 0, 0, 0, 0});
    const CompareRow* best = nullptr;
    for (const CompareRow& other : c.rows)
      if (same_task(other, r) && other.solved() && (!best || other.wall_seconds < best->wall_seconds)) best = &other;
    if (at == sums.begin()) {
      ++tasks;
      unsolved += best ? 0 : 1;
    }
    ++at->tasks;
    at->elsewhere += r.branch == "another" ? 1 : 0;
    at->inaccurate += r.branch == "inaccurate" || r.inaccurate() ? 1 : 0;
    if (!r.solved()) continue;
    ++at->solved;
    at->iterations += r.iterations;
    at->fastest += as_fast(r, *best) ? 1 : 0;
    at->log_ratio += std::log(r.wall_seconds / best->wall_seconds);
    if (!(r.error_rms >= 0)) continue;
    ++at->with_error;
    at->log_error += std::log(std::max(r.known_error() / r.size, 1e-17));
  }
  std::string out = fmt::format("\n## All {} tasks together\n\nA task is a problem with a tolerance and a time step. *Fastest*: tasks in which the solver is as fast as the "
                                "fastest one, within the spread of the repetitions. *Slowdown* is the time over that of the fastest solver, *error* the RMS error over the size of "
                                "the moving objects (errors below the noise floor count as the floor). Both are geometric means over the tasks that the solver solved; "
                                "iterations are their sum. A converged result counts as solved if its relative error (of the worst vertex) is at most {:g} (`error_limit`{}); beyond, it is "
                                "*inaccurate*.", tasks, config.error_limit.value_or(CompareConfig::error_limit_default),
                                config.error_limit || !config.reference_time_step ? "" : "; not applied to other time steps than the reference's");
  if (unsolved > 0) out += fmt::format(" No solver solved {} of the tasks.", unsolved);
  out += "\n\n| solver | solved | fastest | slowdown | iterations | error | another branch | inaccurate |\n"
         "| --- | --- | --- | --- | --- | --- | --- | --- |\n";
  std::stable_sort(sums.begin(), sums.end(), [](const Sum& a, const Sum& b) {
    const auto slowness = [](const Sum& s) { return s.log_ratio / std::max(s.solved, 1); };
    return a.solved != b.solved ? a.solved > b.solved : slowness(a) < slowness(b);
  });
  for (const Sum& s : sums)
    out += fmt::format("| {} | {} | {} | {} | {} | {} | {} | {} |\n", cell(s.solver), s.solved, s.fastest,
                       s.solved ? fmt::format("{:.2f}", std::exp(s.log_ratio / s.solved)) : "", s.iterations,
                       s.with_error ? fmt::format("{:.0e}", std::exp(s.log_error / s.with_error)) : "", s.elsewhere, s.inaccurate);
  return out;
}

// Returns the reason why errors do not rank the solvers of a problem; "" if they do.
std::string ranking_obstacle(const Comparison& c, const ReferenceRow& of) {
  if (of.tolerance == 0) return "there is no reference, so that errors are unknown";
  size_t solved = 0, below_floor = 0;
  for (const CompareRow& r : c.rows) {
    if (r.problem != of.problem || !r.solved() || !std::isfinite(r.error_rms)) continue;
    ++solved;
    below_floor += r.below_floor() ? 1 : 0;
  }
  if (solved == 0) return "no solver solved it";
  if (below_floor < solved) return "";
  return fmt::format("all errors are below the noise floor of {:.1e} m, and smaller tolerances have no visible effect. If nearby runs "
                     "diverge (after a detachment, in chaotic motion), compare fewer `steps`", of.floor);
}

// Formats an error, or its upper bound if it is noise.
std::string error_text(const CompareRow& r) { return r.below_floor() ? fmt::format("below {:.1e}", r.floor) : fmt::format("{:.1e}", r.error_rms); }

std::string pareto(const Comparison& c) {
  const std::string head = "\n## Fastest at each level of error\n\nRMS error of the positions at the end of a run; "
                           "in a single step, the distance to the refined minimum of the solver. Levels end at the noise floor. A "
                           "level is omitted if the fastest solver of a looser level reaches it too.\n";
  std::string rows, without, last_problem;
  for (const ReferenceRow& of : c.references) {
    if (of.problem == last_problem) continue;
    last_problem = of.problem;
    if (const std::string why = ranking_obstacle(c, of); !why.empty()) {
      without += fmt::format("- {}: {}.\n", cell(of.problem), why);
      continue;
    }
    double largest = 0;
    for (const CompareRow& r : c.rows)
      if (r.problem == of.problem && r.solved() && std::isfinite(r.error_rms)) largest = std::max(largest, r.known_error());
    const CompareRow* shown = nullptr;
    for (int decade = static_cast<int>(std::ceil(std::log10(largest) - 1e-9)); decade >= -17; --decade) {
      const double level = std::pow(10.0, decade);
      const CompareRow* best = fastest(c, of, level);
      const CompareRow* next = fastest(c, of, level / 10);
      if (!best) break;
      if (best == shown || best == next) continue;
      shown = best;
      rows += fmt::format("| {} | 1e{} | {} | {:.0e} | {:g} | {:.4g} | {:.2g} | {} | {} | {} |\n", cell(of.problem), decade,
                          cell(best->solver), best->tolerance, best->time_step, best->wall_seconds, best->wall_spread,
                          best->iterations, error_text(*best), cell(equally_fast(c, *best, level)));
    }
  }
  if (!rows.empty())
    rows = "\n| problem | error at most [m] | solver | tolerance [m/s] | h [s] | time [s] | spread [s] | iterations | error [m] | as fast, within the "
           "spread |\n| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n" + rows;
  return head + rows + (without.empty() ? "" : "\nNot ranked:\n\n" + without);
}

std::string failures(const Comparison& c) {
  std::string rows;
  for (const CompareRow& r : c.rows) {
    const bool elsewhere = r.branch == "another" || r.branch == "inaccurate";
    if (r.converged && !elsewhere && !r.inaccurate() && r.intersections == 0 && r.crossing_pairs == 0) continue;
    std::string outcome = r.converged ? "" : r.status;
    if (r.branch == "another")
      outcome = r.single_step ? fmt::format("another minimum, {:.3g} J {} the reference's", std::abs(r.energy_gap),
                                         r.energy_gap < 0 ? "below" : "above")
                           : fmt::format("another branch: ended {:.1e} m from the reference", r.error_max);
    if (r.inaccurate())
      outcome += fmt::format("{}inaccurate: {:.1e} m from {}, {:.1e} of the size (error_limit: {:g})", outcome.empty() ? "" : "; ", r.error_max,
                             r.single_step ? "its minimum" : "the reference", r.relative_error, r.error_limit);
    else if (r.branch == "inaccurate")
      outcome = fmt::format("inaccurate: ended {:.1e} m from the reference, closer with smaller tolerances", r.error_max);
    if (r.intersections > 0) outcome += fmt::format(" {} intersections", r.intersections);
    if (r.crossing_pairs > 0) outcome += fmt::format(" surfaces passed through each other: at most {:g} pairs, {:.2g} m deep", r.crossing_pairs, r.penetration);
    rows += fmt::format("| {} | {} | {:.0e} | {:g} | {} |\n", cell(r.problem), cell(r.solver), r.tolerance, r.time_step,
                        cell(outcome));
  }
  if (rows.empty()) return "\nEverything converged, to the solution of the reference.\n";
  return "\n## Failures and other solutions\n\n| problem | solver | tolerance [m/s] | h [s] | result |\n"
         "| --- | --- | --- | --- | --- |\n" + rows;
}

}  // namespace

std::string compare_report(const CompareConfig& config, const Comparison& c, const Provenance& provenance, double wall_seconds) {
  return header(config, provenance, wall_seconds) + references(c) + joint_table(config, c) + pareto(c) + failures(c) +
         "\nAll numbers: compare.csv; their provenance: compare.json. Pictures: plots/.\n";
}

}  // namespace tack
