#include "framework/batch/batch_preparation.hpp"

#include <fmt/format.h>
#include <fnmatch.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <set>

#include "framework/batch/hdf5_library.hpp"
#include "framework/batch/resolved_case.hpp"
#include "framework/batch/results_hdf5.hpp"
#include "framework/output/run_folder.hpp"
#include "geometry/errors.hpp"
#include "geometry/io/replace_file.hpp"

namespace tack {
namespace {

constexpr size_t reported_errors_max = 10;

// Returns the error of a case; "" if it has none.
std::string case_error(const BatchPlan& plan, const BatchCase& one) {
  try {
    check_case(plan, one);
    return "";
  } catch (const InputError& error) {
    return error.what();
  }
}

// Builds every open case once, one of each group of equal cases; reports all errors together.
void check_cases(const BatchPlan& plan, const std::vector<const BatchCase*>& open, const std::function<void(size_t done, size_t all)>& progress) {
  std::vector<const BatchCase*> different;
  std::set<std::string> digests;
  for (const BatchCase* one : open)
    if (digests.insert(one->digest).second) different.push_back(one);
  std::vector<std::string> case_errors(different.size());
  const auto check = [&](size_t i) { case_errors[i] = case_error(plan, *different[i]); };
  // Shared data are set up before several threads build cases.
  if (!different.empty()) check(0);
  constexpr size_t at_once = 64;
  for (size_t first = 1; first < different.size(); first += at_once) {
    progress(first, different.size());
    tbb::parallel_for(first, std::min(first + at_once, different.size()), check);
  }
  std::vector<std::string> errors;
  std::set<std::string> printed;  // an error of many cases is printed once
  for (size_t i = 0; i < different.size() && errors.size() < reported_errors_max; ++i)
    if (const std::string& what = case_errors[i]; !what.empty() && printed.insert(what).second)
      errors.push_back(what.find(different[i]->name) == what.npos ? fmt::format("{} (case '{}')", what, different[i]->name) : what);
  if (!errors.empty()) throw InputError(fmt::format("{}", fmt::join(errors, "\n")));
}

void check_names(const BatchPlan& plan, const std::vector<std::string>& patterns) {
  for (const std::string& pattern : patterns)
    if (std::none_of(plan.cases.begin(), plan.cases.end(), [&](const BatchCase& one) { return is_named({pattern}, one); }))
      throw InputError(fmt::format("--only {}: no case has such a name; the first is '{}', --dry-run lists them", pattern, plan.cases.front().name));
}

}  // namespace

bool is_named(const std::vector<std::string>& names, const BatchCase& one) {
  return names.empty() || std::any_of(names.begin(), names.end(), [&](const std::string& name) { return fnmatch(name.c_str(), one.name.c_str(), 0) == 0; });
}

PreparedBatch prepare_batch(const BatchConfig& config, const BatchSettings& settings, const PreparationObserver& observer) {
  const auto print = [&](const std::string& line) {
    if (observer.print) observer.print(line);
  };
  const auto progress = [&](const char* what) {
    return [&observer, what](size_t done, size_t all) {
      if (observer.progress) observer.progress(what, done, all);
    };
  };
  PreparedBatch batch;
  BatchDescription& d = batch.description;
  d.plan = plan_of(config, program_digest(), progress("planned"));
  for (const std::string& line : d.plan.warnings) print("warning: " + line);
  d.file = settings.file;
  d.limits.threads = settings.threads > 0 ? settings.threads : config.threads;
  d.limits.jobs = jobs_that_fit(settings.jobs > 0 ? settings.jobs : config.jobs, d.limits.threads, config.memory);
  d.limits.memory = config.memory;
  d.limits.time_limit = config.time_limit;
  d.provenance = provenance_text(settings.provenance);
  d.table = settings.table.value_or(config.table);
  if (d.table == BatchTable::hdf5) open_hdf5_library();
  check_names(d.plan, settings.only);
  const std::filesystem::path root = RunFolder::chosen_root(settings.output, config.name);
  const BatchFolder there{std::filesystem::weakly_canonical(root), nullptr};
  const auto find_open = [&](const BatchFolder& folder) {
    batch.open = open_cases(folder, d.plan, settings.rerun_failed);
    batch.done = d.plan.cases.size() - batch.open.size();
    std::erase_if(batch.open, [&](const BatchCase* one) { return !is_named(settings.only, *one); });
  };
  find_open(there);
  check_cases(d.plan, batch.open, progress("checked"));
  if (settings.dry_run) {
    batch.folder = there;
    return batch;
  }
  batch.folder = BatchFolder::opened(root, is_other_batch(there, d));
  if (batch.folder.moved_aside) print(fmt::format("another batch that was there is moved to {}", batch.folder.moved_aside->string()));
  find_open(batch.folder);  // another call may have ended cases meanwhile
  write_description(batch.folder, d, states_of(batch.folder, d.plan));
  return batch;
}

std::vector<CaseState> write_batch_table(const BatchFolder& folder, const BatchDescription& description) {
  std::vector<CaseState> states = states_of(folder, description.plan);
  write_description(folder, description, states);
  const ResultsTable table = results_of(folder, description.plan, states);
  replace_file(folder.table(), csv_text(table));
  if (description.table == BatchTable::hdf5) write_results_hdf5(folder.hdf5(), table, description);
  else std::filesystem::remove(folder.hdf5());  // of earlier results
  return states;
}

}  // namespace tack
