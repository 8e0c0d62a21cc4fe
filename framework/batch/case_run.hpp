// One case of a batch as a process: starts or resumes it, and records how it ended.
#pragma once

#include "framework/batch/batch_description.hpp"
#include "framework/batch/child_process.hpp"

namespace tack {

class CaseRun {
 public:
  // Starts `program run` on the scene of the case. An interrupted run with a checkpoint is resumed
  // from its newest one; other results of the same case are removed, and results of another case
  // with the same name are moved aside. Throws InputError if files cannot be written.
  CaseRun(const std::string& program, const BatchFolder& folder, const BatchCase& one,
          const BatchLimits& limits);

  // Returns true once the process has ended and its state is written. Also enforces the time limit.
  bool ended();
  // Interrupts it as Ctrl-C does; kills it if it does not end within a grace period.
  void interrupt();
  const CaseState& state() const { return state_; }  // once it has ended
  double seconds() const { return process_.seconds(); }
  double fraction() const;  // completed fraction of the simulated time

 private:
  ChildProcess start(bool resume);
  void add_up();
  void settle();
  std::string last_output_line() const;
  std::string memory_error() const;

  std::string program_;
  BatchFolder folder_;
  const BatchCase& case_;
  BatchLimits limits_;
  CaseState before_;  // times and memory of earlier processes of a resumed run
  CaseState state_;
  bool resumed_ = false, timed_out_ = false;
  double state_written_at_ = 0;  // s of its life at the last write of its state
  double killed_at_ = -1;        // s of its life at which it is killed; negative: not interrupted
  ChildProcess process_;
};

}  // namespace tack
