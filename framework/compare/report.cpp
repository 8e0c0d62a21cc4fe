#include "framework/compare/report.hpp"

#include <fmt/format.h>

#include <cmath>

namespace tack {
namespace {

// A bar would end the cell of a table, a line's end the table, and < begin a tag.
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
  return fmt::format("# {}\n\n{}\n\nMeasured with tack {} ({}; {}, {}) on {} ({}), {} threads, from {}, by `{}`; {} repetitions, "
                     "interleaved, medians; every solve in a world of its own, loading not timed. {:.0f} s in all. Times depend "
                     "on the machine and on what else it does: compare them within this table.\n",
                     cell(config.name), config.about, p.build.version, p.build.sources(), p.build.compiler, p.build.flags,
                     p.machine.host, p.machine.description(), p.threads, p.date, p.command_line, config.repeat, wall_seconds);
}

std::string references(const Comparison& c) {
  std::string out = "\n## References\n\nProjected Newton (clamped) to the tolerance shown; *apart* is the largest distance to "
                    "a second solution with absolute projection and CHOLMOD: errors below it mean nothing.\n\n"
                    "| problem | h [s] | unknowns | size [m] | tolerance [m/s] | apart [m] | |\n| --- | --- | --- | --- | --- | --- | --- |\n";
  for (const ReferenceRow& r : c.references) {
    std::string remark = r.other_branch ? "**the two are different solutions**" : "";
    if (r.tolerance == 0) remark = "**none: " + cell(r.status) + "**";
    if (r.quasi_static) remark += " quasi-static: stops by `force_tolerance`";
    out += fmt::format("| {} | {:g} | {} | {:.3g} | {:.0e} | {:.1e} | {} |\n", cell(r.problem), r.time_step, r.unknowns,
                       r.size, r.tolerance, r.disagreement, remark);
  }
  return out;
}

// The fastest of a problem whose error is at most `level` (RMS, m); nullptr if there is none.
const CompareRow* fastest(const Comparison& c, const ReferenceRow& of, double level) {
  const CompareRow* best = nullptr;
  for (const CompareRow& r : c.rows)
    if (r.problem == of.problem && r.solved() && r.error_rms <= level && (!best || r.wall_seconds < best->wall_seconds))
      best = &r;
  return best;
}

// Whose times at this level cannot be told from the fastest one's: the ranges of their repetitions overlap.
std::string as_fast(const Comparison& c, const CompareRow& best, double level) {
  std::string names;
  for (const CompareRow& r : c.rows) {
    if (&r == &best || r.solver == best.solver || r.problem != best.problem || !r.solved() || r.error_rms > level) continue;
    if (r.wall_seconds - r.wall_spread / 2 > best.wall_seconds + best.wall_spread / 2) continue;
    if (names.find(cell(r.solver)) == names.npos) names += (names.empty() ? "" : ", ") + cell(r.solver);
  }
  return names;
}

std::string pareto(const Comparison& c) {
  std::string out = "\n## Fastest at each level of error\n\nRMS error of the positions: of a run, at its end; "
                    "of a single step, against the minimum that the solver came to, refined. A level that a looser one's winner "
                    "meets as well is left out.\n\n| problem | error at most [m] | solver | tolerance [m/s] | h [s] "
                    "| time [s] | spread [s] | iterations | error [m] | as fast, within the spread |\n"
                    "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n";
  std::string last_problem;
  for (const ReferenceRow& of : c.references) {
    if (of.problem == last_problem) continue;
    last_problem = of.problem;
    const CompareRow* shown = nullptr;
    for (int decade = -1; decade >= -15; --decade) {
      const double level = std::pow(10.0, decade);
      const CompareRow* best = fastest(c, of, level);
      const CompareRow* next = fastest(c, of, level / 10);
      if (!best) break;
      if (best == shown || best == next) continue;
      shown = best;
      out += fmt::format("| {} | 1e{} | {} | {:.0e} | {:g} | {:.4g} | {:.2g} | {} | {:.1e} | {} |\n", cell(of.problem), decade,
                         cell(best->solver), best->tolerance, best->time_step, best->wall_seconds, best->wall_spread,
                         best->iterations, best->error_rms, as_fast(c, *best, level));
    }
  }
  return out;
}

std::string failures(const Comparison& c) {
  std::string rows;
  for (const CompareRow& r : c.rows) {
    if (r.converged && r.branch != "another" && r.intersections == 0) continue;
    std::string what = r.converged ? "" : r.status;
    if (r.branch == "another")
      what = r.single_step ? fmt::format("another minimum, {:.3g} J {} the reference's", std::abs(r.energy_gap),
                                         r.energy_gap < 0 ? "below" : "above")
                           : fmt::format("ended {:.1e} m from the reference", r.error_max);
    if (r.intersections > 0) what += fmt::format(" {} intersections", r.intersections);
    rows += fmt::format("| {} | {} | {:.0e} | {:g} | {} |\n", cell(r.problem), cell(r.solver), r.tolerance, r.time_step,
                        cell(what));
  }
  if (rows.empty()) return "\nEverything converged, to the solution of the reference.\n";
  return "\n## What failed or went elsewhere\n\n| problem | solver | tolerance [m/s] | h [s] | what |\n"
         "| --- | --- | --- | --- | --- |\n" + rows;
}

}  // namespace

std::string compare_report(const CompareConfig& config, const Comparison& c, const Provenance& provenance, double wall_seconds) {
  return header(config, provenance, wall_seconds) + references(c) + pareto(c) + failures(c) +
         "\nAll numbers: compare.csv, and compare.json for where they come from. Pictures: plots/.\n";
}

}  // namespace tack
