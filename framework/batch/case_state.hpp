// What became of a case of a batch: state/NAME.json in the batch's folder, written when it starts and when it ends, so that a
// batch that was killed at any moment knows what is done.
#pragma once

#include <filesystem>
#include <string>

namespace tack {

enum class CaseStatus {
  waiting,              // or of an earlier form: another scene, other files, another program
  running,              // or ended together with the batch
  done,
  expectation_failed,
  simulation_failed,
  refused,              // bad input, noticed by the run itself
  crashed,
  timed_out,
  interrupted
};
std::string_view to_string(CaseStatus status);  // "done", "expectation failed", ...

// Not to be run again unless asked for.
bool finished(CaseStatus status);
bool failed(CaseStatus status);  // finished, and not as wanted

struct CaseState {
  CaseStatus status = CaseStatus::waiting;
  std::string digest;       // of the case when it ran
  std::string error;        // why it failed
  double wall_seconds = 0;  // of the process; of a case that was gone on with, of all of its processes
  double cpu_seconds = 0;   // likewise
  double memory_mb = 0;     // most that was resident at once
};

// Waiting if the file is not there, or damaged.
CaseState read_case_state(const std::filesystem::path& path);
// Throws InputError if it cannot be written.
void write_case_state(const std::filesystem::path& path, const CaseState& state);

}  // namespace tack
