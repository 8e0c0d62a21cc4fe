// tack run --dump-problem: stores single steps of a run as problems
// (framework/output/state_file.hpp). A stored step starts with fresh factors and candidates, so
// that minimising its problem again gives the bits of the run.
#pragma once

#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "framework/output/state_file.hpp"

namespace tack {

class ProblemDump {
 public:
  // requests: "step=K" (counted from 1, as in steps.csv) or "hardest=N" (the N steps with most
  // Newton iterations). Throws InputError for anything else.
  explicit ProblemDump(const std::vector<std::string>& requests);

  // Returns true if step `step` may be stored.
  bool wants(int step) const { return hardest_ > 0 || steps_.count(step) > 0; }
  // Announces the step from `state` with size h. A step requested by number is stored at once, so
  // that a failing step is stored too. store: writes a problem.
  using Store = std::function<void(const State& state, double h, int iterations)>;
  void before(const State& state, double h, const Store& store);
  void after(int iterations);
  // Stores the hardest steps, which are known at the end.
  void finish(const Store& store);
  // Steps requested by number that the run did not reach.
  const std::set<int>& missed() const { return steps_; }

 private:
  struct Candidate {
    State state;
    double h;
    int iterations;
  };
  std::set<int> steps_;
  int hardest_ = 0;
  std::vector<Candidate> candidates_;  // most iterations first
  Candidate next_{};
};

}  // namespace tack
