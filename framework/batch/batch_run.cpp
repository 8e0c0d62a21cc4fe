#include "framework/batch/batch_run.hpp"

#include <unistd.h>

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <thread>
#include <utility>

#include "geometry/errors.hpp"
#include "geometry/interrupt.hpp"

namespace tack {
namespace {

// Returns a memory size of the machine in MB, "MemTotal" or "MemAvailable"; infinite if the kernel
// does not report it.
double machine_memory(const std::string& what) {
  std::ifstream in("/proc/meminfo");
  std::string name, unit;
  for (double kb; in >> name >> kb; std::getline(in, unit))
    if (name == what + ":") return kb / 1024;
  return std::numeric_limits<double>::infinity();
}

class Runner {
 public:
  Runner(const std::string& program, const BatchFolder& folder, const BatchLimits& limits, const BatchObserver& observer)
      : program_(program), folder_(folder), limits_(limits), observer_(observer) {}

  void run(const MoreCases& more) {
    while (!running_.empty() || (!interrupt_requested && (more(waiting_) || !waiting_.empty()))) {
      if (interrupt_requested)
        for (Running& r : running_) r.run.interrupt();
      collect();
      if (!interrupt_requested) more(waiting_);
      while (!interrupt_requested && next_case_fits()) {
        const BatchCase* const one = waiting_.front();
        waiting_.pop_front();
        unless_unwritable(*one, [&] {
          running_.push_back({one, CaseRun(program_, folder_, *one, limits_)});
        });
      }
      report_progress();
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
  }

 private:
  struct Running {
    const BatchCase* one;
    CaseRun run;
  };

  // Acts for a case. Returns false if its files cannot be written: the case has failed then, and no
  // earlier state of it remains.
  template <class Act>
  bool unless_unwritable(const BatchCase& one, const Act& act) {
    std::string why;
    try {
      act();
      return true;
    } catch (const InputError& error) {
      why = error.what();
    } catch (const std::filesystem::filesystem_error& error) {
      why = error.what();
    }
    const CaseState state{CaseStatus::refused, one.digest,
                          fmt::format("cannot be written: {}", why)};
    try {
      write_case_state(folder_.state(one.name), state);
    } catch (const InputError&) {
      std::error_code kept;
      std::filesystem::remove(folder_.state(one.name), kept);
    }
    if (observer_.ended) observer_.ended(one, state);
    return false;
  }

  void collect() {
    for (auto r = running_.begin(); r != running_.end();) {
      bool ended = false;
      if (!unless_unwritable(*r->one, [&] { ended = r->run.ended(); })) {
        r = running_.erase(r);
        continue;
      }
      if (!ended) {
        ++r;
        continue;
      }
      largest_ = std::max(largest_, r->run.state().memory_mb);
      if (observer_.ended) observer_.ended(*r->one, r->run.state());
      r = running_.erase(r);
    }
  }

  // Returns true if the next case fits; the largest memory of finished cases estimates its memory.
  bool next_case_fits() const {
    if (waiting_.empty() || static_cast<int>(running_.size()) >= limits_.jobs) return false;
    return running_.empty() || limits_.memory || machine_memory("MemAvailable") > 1.2 * largest_;
  }

  void report_progress() {
    if (!observer_.tick) return;
    std::vector<BatchObserver::Running> running;
    for (const Running& r : running_) running.push_back({r.one, &r.run});
    observer_.tick(running, waiting_.size());
  }

  const std::string& program_;
  const BatchFolder& folder_;
  const BatchLimits& limits_;
  const BatchObserver& observer_;
  std::list<const BatchCase*> waiting_;
  std::list<Running> running_;
  double largest_ = 0;  // MB, over the finished cases
};

}  // namespace

void run_cases(const std::string& program, const BatchFolder& folder, const BatchLimits& limits,
               const std::vector<const BatchCase*>& cases, const BatchObserver& observer) {
  bool given = false;
  run_cases(program, folder, limits, [&](std::list<const BatchCase*>& waiting) {
    if (!std::exchange(given, true)) waiting.assign(cases.begin(), cases.end());
    return false;
  }, observer);
}

void run_cases(const std::string& program, const BatchFolder& folder, const BatchLimits& limits, const MoreCases& more,
               const BatchObserver& observer) {
  Runner(program, folder, limits, observer).run(more);
}

std::vector<const BatchCase*> open_cases(const BatchFolder& folder, const BatchPlan& plan, bool again) {
  std::vector<const BatchCase*> open;
  for (const BatchCase& one : plan.cases) {
    const CaseStatus status = state_of(folder, one).status;
    const bool kept = std::filesystem::exists(folder.run(one.name));
    if (!finished(status) || (status == CaseStatus::done && !kept) || (again && failed(status))) open.push_back(&one);
  }
  return open;
}

int jobs_that_fit(int wanted, int threads, std::optional<double> memory) {
  const int cores = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  int jobs = wanted > 0 ? wanted : std::max(1, cores / threads);
  if (memory) jobs = std::min(jobs, static_cast<int>(machine_memory("MemTotal") / (*memory * 1e3)));
  return std::max(1, jobs);
}

}  // namespace tack
