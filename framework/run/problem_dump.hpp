// tack run --dump-problem: stores single steps of a run as problems (framework/output/state_file.hpp).
// A step that is stored starts afresh, without what the steps before left in factors and candidates, so
// that its problem gives the bits of the run when it is minimised again.
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
  // `requests`: "step=K" (counted from 1, as in steps.csv) or "hardest=N" (the N steps with most Newton
  // iterations). Throws InputError for anything else.
  explicit ProblemDump(const std::vector<std::string>& requests);

  // Whether step `step` may have to be stored.
  bool wants(int step) const { return hardest_ > 0 || steps_.count(step) > 0; }
  // The step from `state` with size h comes next; stored at once if it was asked for by number, so that
  // a step that fails is kept too. `store` writes a problem.
  using Store = std::function<void(const State& state, double h, int iterations)>;
  void before(const State& state, double h, const Store& store);
  void after(int iterations);
  // The hardest steps, which are known at the end.
  void finish(const Store& store);
  // Steps asked for by number that the run did not reach.
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
