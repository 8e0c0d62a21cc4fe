// State of a case of a batch: state/NAME.json in the batch's folder, written when the case starts
// and when it ends, so that a killed batch can be continued.
#pragma once

#include <filesystem>
#include <string>

namespace tack {

enum class CaseStatus {
  waiting,  // or ran in another form: other scene, files or program
  running,  // or killed together with the batch
  done,
  expectation_failed,
  simulation_failed,
  refused,  // bad input, noticed by the run itself
  crashed,
  timed_out,
  interrupted
};
std::string_view to_string(CaseStatus status);  // "done", "expectation failed", ...

// Returns true for a case that runs again only on request.
bool finished(CaseStatus status);
bool failed(CaseStatus status);  // finished with another status than done

struct CaseState {
  CaseStatus status = CaseStatus::waiting;
  std::string digest;  // checksum of the case when it ran
  std::string error;   // why it failed
  // Time of the process; of a resumed case, summed over its processes. So is cpu_seconds.
  double wall_seconds = 0;
  double cpu_seconds = 0;  // CPU time of all threads
  double memory_mb = 0;    // peak resident memory
};

// Reads a state; waiting if the file is missing or damaged.
CaseState read_case_state(const std::filesystem::path& path);
// Writes a state. Throws InputError if it cannot be written.
void write_case_state(const std::filesystem::path& path, const CaseState& state);

}  // namespace tack
