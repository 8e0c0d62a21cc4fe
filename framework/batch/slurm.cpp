#include "framework/batch/slurm.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <thread>

#include "framework/batch/slurm_tasks.hpp"
#include "framework/output/provenance.hpp"
#include "geometry/errors.hpp"
#include "geometry/interrupt.hpp"
#include "geometry/io/replace_file.hpp"

namespace tack {
namespace {

// Formats task numbers as "0-3,7,9-10".
std::string ranges(const std::vector<size_t>& numbers) {
  std::string text;
  for (size_t i = 0; i < numbers.size();) {
    size_t k = i;
    while (k + 1 < numbers.size() && numbers[k + 1] == numbers[k] + 1) ++k;
    text += fmt::format("{}{}", text.empty() ? "" : ",", numbers[i]);
    if (k > i) text += fmt::format("-{}", numbers[k]);
    i = k + 1;
  }
  return text;
}

// Returns the number in the output of `sbatch --parsable`, "12" or "12;cluster" in a line that may
// follow messages; "" while there is none.
std::string job_number(const std::filesystem::path& path) {
  std::ifstream in(path);
  for (std::string line; std::getline(in, line);) {
    const std::string number = line.substr(0, line.find(';'));
    if (!in.eof() && !number.empty() && std::all_of(number.begin(), number.end(), [](unsigned char c) { return std::isdigit(c); })) return number;
  }
  return "";
}

std::string first_line(const std::filesystem::path& path) {
  std::ifstream in(path);
  std::string line;
  std::getline(in, line);
  return line;
}

// submitted: before the refusal.
InputError refusal(const std::filesystem::path& output, int code, const SlurmJobs& submitted) {
  std::ifstream in(output);
  std::string text{std::istreambuf_iterator<char>(in), {}};
  while (!text.empty() && text.back() == '\n') text.pop_back();
  if (code == 127) text = "sbatch is not there; run the batch without --slurm, or on a machine of the cluster";
  if (submitted.ids.empty()) return InputError(fmt::format("Slurm does not take the batch: {}", text));
  return InputError(fmt::format("Slurm does not take all of the batch: {}\n{}; submit the other cases when they have ended", text, submitted.running_text()));
}

// Waits until the process ends; returns its exit code.
int exit_code_of(ChildProcess process) {
  while (!process.ended()) std::this_thread::sleep_for(std::chrono::milliseconds(20));
  return process.exit_code();
}

// Waits until the process ends; returns false if an interrupt request comes first.
bool ends_before_interrupt(ChildProcess& process) {
  while (!process.ended()) {
    if (interrupt_requested) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return true;
}

ChildProcess sbatch(const BatchFolder& folder, const std::vector<std::string>& options, size_t offset, const std::filesystem::path& output) {
  replace_file(output, "");
  std::vector<std::string> arguments{"/usr/bin/env", "sbatch", "--parsable"};
  arguments.insert(arguments.end(), options.begin(), options.end());
  arguments.push_back(folder.job_script());
  if (offset > 0) arguments.push_back(std::to_string(offset));
  return {arguments, output};
}

// Returns MaxArraySize of the cluster; Slurm's default if scontrol does not know it, or at an interrupt.
size_t max_array_size(const BatchFolder& folder) {
  constexpr size_t slurm_default = 1001;
  const auto output = folder.root / "output" / "scontrol.txt";
  replace_file(output, "");
  ChildProcess process({"/usr/bin/env", "scontrol", "show", "config"}, output);
  if (!ends_before_interrupt(process) || process.exit_code() != 0) return slurm_default;
  std::ifstream in(output);
  std::string key, equals;
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    if (size_t size = 0; words >> key >> equals >> size && key == "MaxArraySize") return std::max<size_t>(size, 1);
  }
  return slurm_default;
}

// Quotes a word of an #SBATCH line, which a blank would end.
std::string quoted(const std::string& word) {
  std::string text = "\"";
  for (const char c : word) text += c == '"' || c == '\\' ? std::string{'\\', c} : std::string(1, c);
  return text + "\"";
}

// Escapes the folder of a batch for a pattern of file names: "%%" is a percent sign there.
std::string in_pattern(const std::string& folder) {
  if (folder.find('\\') != folder.npos)
    throw InputError(fmt::format("{}: Slurm replaces nothing in names of files with a backslash; take another folder (-o)", folder));
  std::string text;
  for (const char c : folder) text += c == '%' ? "%%" : std::string(1, c);
  return text;
}

}  // namespace

std::vector<JobArray> job_arrays(const std::vector<size_t>& cases, size_t size) {
  std::vector<JobArray> arrays;
  std::vector<size_t> tasks;
  for (size_t i = 0; i < cases.size(); ++i) {
    const size_t offset = cases[i] / size * size;
    tasks.push_back(cases[i] - offset);
    if (i + 1 < cases.size() && cases[i + 1] < offset + size) continue;
    arrays.push_back({ranges(tasks), offset});
    tasks.clear();
  }
  return arrays;
}

std::string job_script(const std::string& program, const BatchFolder& folder, const SlurmConfig& s, const BatchLimits& limits) {
  const long minutes = whole_minutes(s.time);
  std::string script = "#!/bin/bash\n";
  const auto option = [&](const std::string& text) {
    if (text.find_first_of("\r\n") != text.npos) throw InputError(fmt::format("slurm: '{}' is no option: it has a line break", text));
    script += "#SBATCH " + text + "\n";
  };
  option("--job-name=" + quoted(folder.root.filename().string()));
  option(fmt::format("--time={}", minutes));
  option(fmt::format("--cpus-per-task={}", limits.threads));
  if (limits.memory) option(fmt::format("--mem={}M", std::lround(std::ceil(*limits.memory * 1e3))));
  if (!s.partition.empty()) option("--partition=" + s.partition);
  if (!s.account.empty()) option("--account=" + s.account);
  option("--output=" + quoted(in_pattern(folder.root / "output") + "/slurm_%A_%a.txt"));
  if (s.requeues > 0) {
    // SIGUSR1 and not SIGTERM, which scancel sends: a cancelled task is not queued again.
    option("--signal=B:USR1@60");
    option("--requeue");
    option("--open-mode=append");
  } else if (minutes > 2) {
    option("--signal=B:TERM@60");
  }
  for (const std::string& o : s.options) option(o);
  for (const std::string& line : s.prologue) script += line + "\n";
  const std::vector<std::string> command{program, "batch", "-o", folder.root};
  script += fmt::format("exec {} --task \"$((SLURM_ARRAY_TASK_ID + ${{1:-0}}))\"{}\n", shell_line(command),
                        s.requeues > 0 ? fmt::format(" --requeues {}", s.requeues) : "");
  return script;
}

bool SlurmJobs::ended() {
  return std::all_of(waiting.begin(), waiting.end(), [](ChildProcess& p) { return p.ended(); });
}

std::string SlurmJobs::running_text() const {
  std::vector<std::string> parts;
  if (!ids.empty()) parts.push_back(fmt::format("{} {} on (`{}` ends {})", names(), ids.size() == 1 ? "goes" : "go", cancel(), ids.size() == 1 ? "it" : "them"));
  if (unanswered) parts.push_back("sbatch had not answered, `squeue --me` lists what Slurm has taken");
  return parts.empty() ? "no job was submitted" : fmt::format("{}", fmt::join(parts, "; "));
}

std::string SlurmJobs::names() const { return fmt::format("{} {}", ids.size() == 1 ? "job" : "jobs", fmt::join(ids, ", ")); }

std::string SlurmJobs::cancel() const { return fmt::format("scancel {}", fmt::join(ids, " ")); }

SlurmJobs submit(const std::string& program, const BatchFolder& folder, const SlurmConfig& slurm, const BatchDescription& batch,
                 const std::vector<size_t>& cases, bool wait) {
  write_tasks(folder, batch.plan.cases, batch.limits);
  replace_file(folder.job_script(), job_script(program, folder, slurm, batch.limits));
  const auto size = slurm.max_array_size > 0 ? static_cast<size_t>(slurm.max_array_size) : max_array_size(folder);
  SlurmJobs jobs;
  for (const JobArray& array : job_arrays(cases, size)) {
    if (interrupt_requested) return jobs;
    std::vector<std::string> options{fmt::format("--array={}{}", array.tasks, slurm.at_once > 0 ? fmt::format("%{}", slurm.at_once) : "")};
    if (wait) options.push_back("--wait");
    // `at_once` limits the tasks of one array: arrays with a limit follow each other.
    if (slurm.at_once > 0 && !jobs.ids.empty()) options.push_back("--dependency=afterany:" + jobs.ids.back());
    const auto output = folder.root / "output" / fmt::format("sbatch{}.txt", array.offset > 0 ? fmt::format("_{}", array.offset) : "");
    ChildProcess process = sbatch(folder, options, array.offset, output);
    // With --wait, sbatch ends when all tasks have ended.
    bool ended = false;
    while (job_number(output).empty() && !ended) {
      if (interrupt_requested) {
        jobs.unanswered = true;
        return jobs;
      }
      ended = process.ended();
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    const std::string id = job_number(output);
    if (id.empty()) throw refusal(output, process.exit_code(), jobs);
    jobs.ids.push_back(id);
    jobs.waiting.push_back(std::move(process));
  }
  if (!wait)
    for (ChildProcess& process : jobs.waiting)
      if (!ends_before_interrupt(process)) break;
  return jobs;
}

void requeue_this_job(const std::filesystem::path& output) {
  const char* job = std::getenv("SLURM_JOB_ID");
  if (!job) throw InputError("--requeues: SLURM_JOB_ID is not set, as it is in a task of Slurm; run the case without it");
  if (const int code = exit_code_of({{"/usr/bin/env", "scontrol", "requeue", job}, output}); code != 0)
    throw InputError(fmt::format("Slurm does not queue job {} again: {}", job, first_line(output)));
}

}  // namespace tack
