// stages.csv: the stages of the protocols of a run, one row per stage that has begun.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "framework/output/csv.hpp"
#include "framework/output/statistic.hpp"

namespace tack {

struct StageVisit {
  std::string protocol, stage;
  int number = 0;             // of the stage in its protocol, from 1
  double begin = 0, end = 0;  // s
  std::string ended_by;       // "force above 0.5 N"; empty: it has not ended
  double value = 0;           // of the probe at the end [SI]; NaN: none
  int repeated = 0;           // steps that were repeated to find its end, or for control
  int cause = -1;             // index of the end among those of the stage; -1: none
};

// Returns when a run was in a stage: a window for each time that it was run through, in order.
// Windows of protocols that have the stage at the same time are united.
std::vector<TimeWindow> windows_of_stage(const std::vector<StageVisit>& visits,
                                         const std::string& stage);

// Replaces the file. Throws InputError if it cannot be written.
void write_stages(const std::filesystem::path& path, const std::vector<StageVisit>& visits);
// Returns the rows of a file; none if it is not there.
std::vector<StageVisit> read_stages(const std::filesystem::path& path);

}  // namespace tack
