#include "framework/calibrate/case_evaluator.hpp"

#include <thread>

#include "framework/batch/results_table.hpp"
#include "framework/batch/slurm.hpp"
#include "geometry/errors.hpp"
#include "geometry/interrupt.hpp"
#include "geometry/io/replace_file.hpp"

namespace tack {
namespace {

// Returns true for a run that can be compared with data, whatever its own expectations.
bool comparable(CaseStatus status) { return status == CaseStatus::done || status == CaseStatus::expectation_failed; }

PointEvaluation failed_evaluation(const PointQueue::Request& request, std::string status, std::string error) {
  PointEvaluation e;
  e.values = request.values;
  e.asked_derivatives = request.derivatives;
  e.status = std::move(status);
  e.error = std::move(error);
  return e;
}

}  // namespace

CaseEvaluator::CaseEvaluator(FittedScenes& scenes, Settings settings) : scenes_(scenes), settings_(std::move(settings)) {}

void CaseEvaluator::serve(PointQueue& queue) {
  pending_.clear();
  running_.clear();
  if (settings_.slurm) serve_by_slurm(queue);
  else serve_here(queue);
}

const BatchCase* CaseEvaluator::case_of(int run, const DesignPoint& values, bool derivatives) {
  BatchCase one = scenes_.case_of(run, values, derivatives);
  const auto [known, is_new] = by_name_.try_emplace(one.name, cases_.size());
  if (is_new) cases_.push_back(std::move(one));
  return &cases_[known->second];
}

bool CaseEvaluator::needs_run(const BatchCase& one) {
  if (started_cases_.contains(&one)) return false;
  const CaseStatus status = state_of(settings_.folder, one).status;
  if (!finished(status)) return true;
  if (comparable(status)) return !std::filesystem::exists(settings_.folder.run(one.name) / "probes.csv");
  return settings_.rerun_failed;
}

void CaseEvaluator::request_cases(PointQueue& queue, PointQueue::Request& request, std::vector<const BatchCase*>& new_cases) {
  PendingRequest pending{&request, {}};
  try {
    for (int run = 0; run < scenes_.runs(); ++run) pending.cases.push_back(case_of(run, request.values, request.derivatives));
  } catch (const InputError& error) {
    PointEvaluation e = failed_evaluation(request, std::string(to_string(CaseStatus::refused)), error.what());
    if (settings_.on_evaluated) settings_.on_evaluated(e);
    return queue.answer(request, std::move(e));
  }
  for (const BatchCase* one : pending.cases)
    if (!running_.contains(one) && needs_run(*one)) {
      running_.insert(one);
      started_cases_.insert(one);
      new_cases.push_back(one);
      ++started_count_;
    }
  pending_.push_back(std::move(pending));
}

// Answers the requests whose runs have all ended.
void CaseEvaluator::answer_completed(PointQueue& queue) {
  std::erase_if(pending_, [&](const PendingRequest& p) {
    if (std::any_of(p.cases.begin(), p.cases.end(), [&](const BatchCase* one) { return running_.contains(one); })) return false;
    PointEvaluation e = evaluation_of(p);
    if (settings_.on_evaluated) settings_.on_evaluated(e);
    queue.answer(*p.request, std::move(e));
    return true;
  });
}

PointEvaluation CaseEvaluator::evaluation_of(const PendingRequest& p) const {
  std::vector<std::filesystem::path> folders;
  for (const BatchCase* one : p.cases) {
    const CaseState state = state_of(settings_.folder, *one);
    if (!comparable(state.status)) return failed_evaluation(*p.request, std::string(to_string(state.status)), state.error);
    folders.push_back(settings_.folder.run(one->name));
  }
  return scenes_.evaluation(p.request->values, p.request->derivatives, folders);
}

void CaseEvaluator::serve_here(PointQueue& queue) {
  const auto more = [&](std::list<const BatchCase*>& waiting) {
    std::vector<const BatchCase*> new_cases;
    for (PointQueue::Request* request : queue.take()) request_cases(queue, *request, new_cases);
    waiting.insert(waiting.end(), new_cases.begin(), new_cases.end());
    answer_completed(queue);
    return !queue.finished();
  };
  const BatchObserver observer{[&](const BatchCase& one, const CaseState& state) {
                                 if (interrupt_requested && state.status == CaseStatus::interrupted) return;
                                 running_.erase(&one);
                                 answer_completed(queue);
                               },
                               [&](const std::vector<BatchObserver::Running>&, size_t) {
                                 if (settings_.on_tick) settings_.on_tick();
                               }};
  run_cases(settings_.program, settings_.folder, settings_.description.limits, more, observer);
}

void CaseEvaluator::serve_by_slurm(PointQueue& queue) {
  for (queue.wait_for_all(); !queue.finished() && !interrupt_requested; queue.wait_for_all()) {
    std::vector<const BatchCase*> new_cases;
    for (PointQueue::Request* request : queue.take()) request_cases(queue, *request, new_cases);
    if (!new_cases.empty()) run_array(new_cases);
    if (interrupt_requested) return;
    running_.clear();
    answer_completed(queue);
  }
}

void CaseEvaluator::run_array(const std::vector<const BatchCase*>& new_cases) {
  const BatchFolder& folder = settings_.folder;
  std::vector<size_t> tasks;
  for (const BatchCase* one : new_cases) {
    tasks.push_back(by_name_.at(one->name));
    replace_file(folder.scene(one->name), one->scene);
    // Without the state of a failed case, its task does not skip it.
    std::filesystem::remove(folder.state(one->name));
  }
  write_tables();
  std::sort(tasks.begin(), tasks.end());
  SlurmJobs jobs = submit(settings_.program, folder, *settings_.slurm, settings_.description, tasks, true);
  while (!jobs.ended() && !interrupt_requested) {
    if (settings_.on_tick) settings_.on_tick();
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
  }
  if (jobs.unanswered || !jobs.ended()) running_jobs_ = jobs.running_text();
}

std::vector<BatchCase> CaseEvaluator::without_scenes() const {
  std::vector<BatchCase> cases(cases_.begin(), cases_.end());
  for (BatchCase& one : cases) one.scene.clear();
  return cases;
}

void CaseEvaluator::write_tables() {
  BatchDescription& d = settings_.description;
  d.plan.cases = without_scenes();
  const std::vector<CaseState> states = states_of(settings_.folder, d.plan);
  write_description(settings_.folder, d, states);
  replace_file(settings_.folder.table(), csv_text(results_of(settings_.folder, d.plan, states)));
}

std::vector<std::filesystem::path> CaseEvaluator::run_folders(const PointEvaluation& of) {
  std::vector<std::filesystem::path> folders;
  for (int run = 0; run < scenes_.runs(); ++run) folders.push_back(settings_.folder.run(case_of(run, of.values, of.asked_derivatives)->name));
  return folders;
}

}  // namespace tack
