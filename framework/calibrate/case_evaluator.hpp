// Evaluates points by runs that are cases of a batch: processes side by side, or one Slurm job
// array for all points that are requested at once. A finished case never runs again.
#pragma once

#include <deque>
#include <functional>
#include <map>
#include <set>

#include "framework/batch/batch_run.hpp"
#include "framework/calibrate/fitted_scenes.hpp"
#include "framework/calibrate/point_queue.hpp"

namespace tack {

class CaseEvaluator : public Evaluator {
 public:
  struct Settings {
    std::string program;
    BatchFolder folder;
    BatchDescription description;  // its plan without cases
    std::optional<SlurmConfig> slurm;
    bool again = false;  // run failed cases again
    std::function<void(const PointEvaluation&)> told;  // called for each evaluated point
    std::function<void()> tick;                   // called several times a second
  };
  CaseEvaluator(FittedScenes& scenes, Settings settings);

  void serve(PointQueue& queue) override;
  std::vector<std::string> without_derivatives() override { return scenes_.without_derivatives(); }

  // Writes batch.json and results.csv of the folder, with all requested cases.
  void write_tables();
  int started() const { return started_; }  // cases that this program had to run
  std::vector<std::filesystem::path> run_folders(const PointEvaluation& of);

 private:
  struct Pending {
    PointQueue::Request* request;
    std::vector<const BatchCase*> cases;  // one for each run
  };

  const BatchCase* case_of(int run, const Point& values, bool derivatives);
  bool to_run(const BatchCase& one);
  void begin(PointQueue& queue, PointQueue::Request& request,
             std::vector<const BatchCase*>& wanted);
  void settle(PointQueue& queue);
  PointEvaluation outcome(const Pending& pending) const;
  void serve_here(PointQueue& queue);
  void serve_by_slurm(PointQueue& queue);
  void run_array(const std::vector<const BatchCase*>& wanted);
  std::vector<BatchCase> without_scenes() const;

  FittedScenes& scenes_;
  Settings settings_;
  std::deque<BatchCase> cases_;
  std::map<std::string, size_t> by_name_;
  // Cases under way; cases that this program ran.
  std::set<const BatchCase*> running_, tried_;
  std::vector<Pending> pending_;
  int started_ = 0;
};

}  // namespace tack
