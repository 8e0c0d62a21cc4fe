#include "tests/hard/robustness_table.hpp"

#include <fmt/format.h>

namespace tack {
namespace {

std::string percent(double fraction) {
  if (fraction < 5e-5) return "0";
  return fraction < 0.1 ? fmt::format("{:.2g}%", 100 * fraction) : fmt::format("{:.0f}%", 100 * fraction);
}

std::string ending(const HardOutcome& o) {
  switch (o.exit_code) {
    case 0: return "done";
    case 1: return "**missed**";
    case 2: return "refused";
    case 3: return "**gave up**";
    default: return "**CRASHED OR HUNG**";
  }
}

std::string cell(const HardOutcome& o) {
  if (!o.ran) return ending(o);
  return fmt::format("{}, {}, {}, {:.2g}", ending(o), o.iterations, percent(o.energy_gain), o.force_residual);
}

// Returns the start of the row of a case.
std::string row_start(const std::string& name) { return fmt::format("\n| `{}` |", name); }

std::string what_is_hard(const std::vector<HardRow>& rows) {
  std::string text = "\n| case | what is hard, and what must hold | energy lost | gains |\n| --- | --- | --- | --- |";
  for (const HardRow& row : rows) {
    const HardOutcome& o = row.outcomes.front();
    text += row_start(row.hard.name) + fmt::format(" {}{} | {} | {} |", row.hard.about,
                row.hard.exit_code ? fmt::format("; ends with {}", row.hard.exit_code) : "",
                o.ran ? percent(o.energy_loss) : "", o.ran ? fmt::to_string(o.gains) : "");
  }
  return text + "\n";
}

std::string how_they_end(const std::vector<HardRow>& rows, const std::vector<HardSolver>& solvers) {
  std::string text = "\n| case |", rule = "\n| --- |";
  for (const HardSolver& solver : solvers) {
    text += fmt::format(" {} |", solver.name);
    rule += " --- |";
  }
  text += rule;
  for (const HardRow& row : rows) {
    text += row_start(row.hard.name);
    for (const HardOutcome& o : row.outcomes) text += fmt::format(" {} |", cell(o));
  }
  return text + "\n";
}

std::string counts(const std::vector<HardRow>& rows, const std::vector<HardSolver>& solvers) {
  std::string text = "\n| solver | done | missed an `expect` | refused | gave up | crashed or hung |\n"
                     "| --- | --- | --- | --- | --- | --- |\n";
  for (size_t s = 0; s < solvers.size(); ++s) {
    int by_code[5] = {};
    for (const HardRow& row : rows) {
      const int code = row.outcomes[s].exit_code;
      ++by_code[code >= 0 && code <= 3 ? code : 4];
    }
    text += fmt::format("| {} | {} | {} | {} | {} | {} |\n", solvers[s].name, by_code[0], by_code[1], by_code[2],
                        by_code[3], by_code[4]);
  }
  return text;
}

std::string what_fails(const std::vector<HardRow>& rows, const std::vector<HardSolver>& solvers) {
  std::string text;
  for (const HardRow& row : rows)
    for (size_t s = 0; s < row.outcomes.size(); ++s)
      for (const std::string& missed : row.outcomes[s].missed_expectations)
        if (row.outcomes[s].exit_code == 1)
          text += fmt::format("- `{}`, {}: {}\n", row.hard.name, solvers[s].name, missed);
  return text.empty() ? "None.\n" : text;
}

// Returns REASON of `step ... failed with h = ... (REASON; BLOCKER); REMEDY`, or of `step ...: REASON; ...`.
std::string reason(const std::string& error) {
  const bool failed = error.find(" failed with ") != std::string::npos;
  const size_t start = error.find(failed ? " (" : ": ");
  std::string text = start == std::string::npos ? error : error.substr(start + 2);
  text = text.substr(0, text.find(';'));
  if (failed && text.ends_with(')')) text.pop_back();
  return text;
}

std::string who_gave_up(const std::vector<HardRow>& rows, const std::vector<HardSolver>& solvers) {
  std::string text;
  for (const HardRow& row : rows)
    for (size_t s = 0; s < row.outcomes.size(); ++s)
      if (row.outcomes[s].exit_code == 3)
        text += fmt::format("- `{}`, {}: {}\n", row.hard.name, solvers[s].name, reason(row.outcomes[s].error));
  return text.empty() ? "None.\n" : text;
}

constexpr const char* introduction = R"(# Robustness

What becomes of scenes that are hard, with several solvers: [experiments/hard](../experiments/hard), a few bodies and
5 to 100 steps each. Every one ends: with what it must show, or with a message that says where and why not.
`./tack test -L hard` runs all with the default solver; this page is written by

```
cmake --build --preset release --target tack_hard && build/release/tests/tack_hard table docs/robustness.md
```

Other solvers, also those of a plugin, on all of them or on those named: `tack_hard table PAGE --plugin libmine.so --solver mine --solver projection=absolute [NAME...]`
(a minimizer, or a key of `solver`).

A solve may take 10 s and a run 20 s, on one thread; what hits such a limit may end elsewhere on another machine.
)";

constexpr const char* legend = R"(
## How each ends

Each cell: how it ended; iterations; the energy that contact areas and time integration made in the steps in which they
made any, of the largest energy in the run; the largest force at a vertex that nothing balances, over what is tolerated
(1 or less: converged; a run that gave up shows its steps up to there).
**done**: with all that it must show. **missed**: an `expect` does not hold, listed below. **refused**: before anything
was written. **gave up**: a step failed however short it was made, or time was up; told, with the pair or tet that
blocks it.
)";

}  // namespace

std::string robustness_page(const std::vector<HardRow>& rows, const std::vector<HardSolver>& solvers) {
  return std::string(introduction) + counts(rows, solvers) + legend + how_they_end(rows, solvers) + "\n## What was missed\n\n" +
         what_fails(rows, solvers) +
         "\n## What ended those that gave up\n\n" + who_gave_up(rows, solvers) +
         "\n## What is hard in each\n\nEnergy lost: what contact areas and time integration took with the default "
         "solver, implicit Euler's damping\nand the impacts that it does not resolve, of the largest energy in the run. "
         "Gains: steps in which energy grew by\nmore than a hundredth of the reference energy so far, without a source. What was gained or lost "
         "by more\nthan 3% of the reference energy of the run is reported at its end ([results.md](results.md#energy-that-was-made-or-lost)).\n" +
         what_is_hard(rows);
}

std::vector<std::string> missing_rows(const std::string& page, const std::vector<HardCase>& cases) {
  std::vector<std::string> missing;
  for (const HardCase& c : cases)
    if (page.find(row_start(c.name)) == std::string::npos) missing.push_back(c.name);
  return missing;
}

}  // namespace tack
