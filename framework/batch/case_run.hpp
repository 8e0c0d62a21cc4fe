// One case of a batch as a process: how it is started, or gone on with, and what became of it.
#pragma once

#include "framework/batch/batch_description.hpp"
#include "framework/batch/child_process.hpp"

namespace tack {

class CaseRun {
 public:
  // Starts `program run` on the scene of the case, from its newest checkpoint if it was cut short and has one; what else
  // is left of the same case is taken away, what is left of another of that name is moved aside. Throws InputError if
  // files cannot be written.
  CaseRun(const std::string& program, const BatchFolder& folder, const BatchCase& one, const BatchLimits& limits);

  // Whether it has ended, its state then being written. Looks after the time limit.
  bool ended();
  void interrupt();  // as Ctrl-C does; killed if it takes longer than a while
  const CaseState& state() const { return state_; }  // once it has ended
  double seconds() const { return process_.seconds(); }
  double fraction() const;  // of the simulated time

 private:
  ChildProcess start(bool resume);
  void add_up();
  void settle();
  std::string last_words() const;
  std::string want_of_memory() const;

  std::string program_;
  BatchFolder folder_;
  const BatchCase& case_;
  BatchLimits limits_;
  CaseState before_;  // what earlier pieces of the run took
  CaseState state_;
  bool resumed_ = false, timed_out_ = false;
  double told_ = 0;        // s of its life at which its state was last written
  double killed_at_ = -1;  // s of its life after which it is killed; negative: not yet asked to end
  ChildProcess process_;
};

}  // namespace tack
