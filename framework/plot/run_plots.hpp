// Default plots of runs, one curve or bar for each run:
//   probe_NAME       each probe over time
//   iterations       Newton iterations per step (Fang et al., figures 18 and 19)
//   step_seconds     wall time per step (figure 19)
//   phases           time of a step by phase
//   phase_shares     fraction of the time in each phase (figure 17)
//   smallest_gap, contacts
//   energies         of a single run: stored energy by term
//   measured_PROBE   a probe over the x of its measured data (measured.csv), with the data as
//                    marks; measured_PROBE_over_X, if there are data over several columns
//   laws             of a single run: traction over gap of adhesive pairs, closed form (laws.csv)
// and plots of any probe over any other. Of a single run with a protocol (stages.csv), probes over
// time have its stages as bands, and a probe over another one has a curve for each stage.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "framework/output/stages_csv.hpp"
#include "framework/plot/plot.hpp"

namespace tack {

struct PlottedRun {
  std::string name;
  CsvTable steps, probes;
  CsvTexts laws, measured;
  // Units of the probes by column, if known.
  std::map<std::string, std::string> units;
  std::vector<StageVisit> stages = {};  // of protocols
};

// Reads the tables of a run's folder. Throws InputError if the folder holds no run.
PlottedRun plotted_run(const std::filesystem::path& folder, const std::string& name);

std::map<std::string, Plot> run_curves(const std::vector<PlottedRun>& runs);
// Plots a column of probes.csv over another, for each run with both. Throws InputError, with the
// nearest name, if no run has them.
Plot probe_curves(const std::vector<PlottedRun>& runs, const std::string& x, const std::string& y);

std::optional<StackedBars> phase_bars(const std::vector<PlottedRun>& runs);
StackedBars percentages_of(StackedBars bars);  // each bar in percent of itself

}  // namespace tack
