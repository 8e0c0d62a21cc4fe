// Default pictures of runs, one curve or bar for each of them:
//   probe_NAME       of each probe, over time
//   iterations       Newton iterations per step (Fang et al., figures 18 and 19)
//   step_seconds     wall time per step (figure 19)
//   phases           the time of a step, phase by phase
//   phase_shares     what part of it each phase takes (figure 17)
//   smallest_gap, contacts
//   energies         of a single run: what is stored, by its terms
//   measured_PROBE   a probe over what its measured data are over (measured.csv), with the data as marks
//   laws             of a single run: traction over gap of its adhesive pairs, in closed form (laws.csv)
// and any probe over any other.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "framework/output/csv.hpp"
#include "framework/plot/plot.hpp"

namespace tack {

struct PlottedRun {
  std::string name;
  CsvTable steps, probes;
  CsvTexts laws, measured;
  std::map<std::string, std::string> units;  // of probes, by column; where they are known
};

// What a folder holds of a run. Throws InputError if it is none.
PlottedRun plotted_run(const std::filesystem::path& folder, const std::string& name);

std::map<std::string, Plot> run_curves(const std::vector<PlottedRun>& runs);
// A column of probes.csv over another, for each run that has both. Throws InputError, with the nearest name, if none has.
Plot probe_curves(const std::vector<PlottedRun>& runs, const std::string& x, const std::string& y);

std::optional<StackedBars> phase_bars(const std::vector<PlottedRun>& runs);
StackedBars shares_of(StackedBars bars);  // each bar as parts of itself, in percent

}  // namespace tack
