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
    bool rerun_failed = false;
    std::function<void(const PointEvaluation&)> on_evaluated;  // called for each evaluated point
    std::function<void()> on_tick;                             // called several times a second
  };
  CaseEvaluator(FittedScenes& scenes, Settings settings);

  void serve(PointQueue& queue) override;
  std::vector<std::string> without_derivatives() override { return scenes_.without_derivatives(); }

  // Writes batch.json and results.csv of the folder, with all requested cases.
  void write_tables();
  int started() const { return started_count_; }  // number of cases that this program ran
  // Returns SlurmJobs::running_text() after an interrupt; "" if no job goes on.
  const std::string& running_jobs() const { return running_jobs_; }
  std::vector<std::filesystem::path> run_folders(const PointEvaluation& of);

 private:
  struct PendingRequest {
    PointQueue::Request* request;
    std::vector<const BatchCase*> cases;  // one for each run
  };

  const BatchCase* case_of(int run, const DesignPoint& values, bool derivatives);
  bool needs_run(const BatchCase& one);
  void request_cases(PointQueue& queue, PointQueue::Request& request,
                     std::vector<const BatchCase*>& new_cases);
  void answer_completed(PointQueue& queue);
  PointEvaluation evaluation_of(const PendingRequest& pending) const;
  void serve_here(PointQueue& queue);
  void serve_by_slurm(PointQueue& queue);
  void run_array(const std::vector<const BatchCase*>& new_cases);
  std::vector<BatchCase> without_scenes() const;

  FittedScenes& scenes_;
  Settings settings_;
  std::deque<BatchCase> cases_;
  std::map<std::string, size_t> by_name_;
  // Cases that run now; all cases that this program started.
  std::set<const BatchCase*> running_, started_cases_;
  std::vector<PendingRequest> pending_;
  int started_count_ = 0;
  std::string running_jobs_;
};

}  // namespace tack
