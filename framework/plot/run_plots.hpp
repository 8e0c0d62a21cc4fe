// Default pictures of runs, one curve or bar for each of them:
//   probe_NAME       of each probe, over time
//   iterations       Newton iterations per step (Fang et al., figures 18 and 19)
//   step_seconds     wall time per step (figure 19)
//   phases           where the time of a step goes, phase by phase (figure 17)
//   smallest_gap, contacts
//   energies         of a single run: what is stored, by its terms
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
};

// What a folder holds of a run. Throws InputError if it is none.
PlottedRun plotted_run(const std::filesystem::path& folder, const std::string& name);

std::map<std::string, Plot> run_curves(const std::vector<PlottedRun>& runs);
std::optional<StackedBars> phase_bars(const std::vector<PlottedRun>& runs);

}  // namespace tack
