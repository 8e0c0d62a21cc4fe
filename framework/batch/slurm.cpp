#include "framework/batch/slurm.hpp"

#include <fmt/format.h>

#include <cctype>
#include <cmath>
#include <fstream>
#include <thread>

#include "framework/output/provenance.hpp"
#include "geometry/errors.hpp"
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

std::string first_line(const std::filesystem::path& path) {
  std::ifstream in(path);
  std::string line;
  std::getline(in, line);
  return line;
}

InputError refusal(const std::filesystem::path& output, int code) {
  std::ifstream in(output);
  std::string text{std::istreambuf_iterator<char>(in), {}};
  while (!text.empty() && text.back() == '\n') text.pop_back();
  if (code == 127) text = "sbatch is not there; run the batch without --slurm, or on a machine of the cluster";
  return InputError(fmt::format("Slurm does not take the batch: {}", text));
}

ChildProcess sbatch(const BatchFolder& folder, std::vector<std::string> options, const std::filesystem::path& output) {
  replace_file(output, "");
  std::vector<std::string> arguments{"/usr/bin/env", "sbatch", "--parsable"};
  arguments.insert(arguments.end(), options.begin(), options.end());
  arguments.push_back(folder.job_script());
  return {arguments, output};
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

std::string number_of(const std::string& line) { return line.substr(0, line.find(';')); }

}  // namespace

std::string job_script(const std::string& program, const BatchFolder& folder, const BatchConfig& config, const BatchLimits& limits,
                       const std::vector<size_t>& tasks) {
  const SlurmConfig& s = config.slurm;
  const long minutes = std::lround(std::ceil(s.time / 60));
  std::string script = "#!/bin/bash\n";
  const auto option = [&](const std::string& text) {
    if (text.find_first_of("\r\n") != text.npos) throw InputError(fmt::format("slurm: '{}' is no option: it has a line break", text));
    script += "#SBATCH " + text + "\n";
  };
  option("--job-name=" + quoted(folder.root.filename().string()));
  option(fmt::format("--array={}{}", ranges(tasks), s.at_once > 0 ? fmt::format("%{}", s.at_once) : ""));
  option(fmt::format("--time={}", minutes));
  option(fmt::format("--cpus-per-task={}", limits.threads));
  if (limits.memory) option(fmt::format("--mem={}M", std::lround(std::ceil(*limits.memory * 1e3))));
  if (!s.partition.empty()) option("--partition=" + s.partition);
  if (!s.account.empty()) option("--account=" + s.account);
  option("--output=" + quoted(in_pattern(folder.root / "output") + "/slurm_%A_%a.txt"));
  if (minutes > 2) option("--signal=B:TERM@60");
  for (const std::string& o : s.options) option(o);
  script += fmt::format("exec {} --task \"$SLURM_ARRAY_TASK_ID\"\n", shell_line({program, "batch", "-o", folder.root}));
  return script;
}

SlurmJob submit(const BatchFolder& folder) {
  const auto output = folder.root / "output" / "sbatch.txt";
  SlurmJob job{"", sbatch(folder, {"--wait"}, output)};
  // sbatch prints the number first, and ends when all tasks have ended.
  while (first_line(output).empty() && !job.waiting.ended()) std::this_thread::sleep_for(std::chrono::milliseconds(20));
  job.id = number_of(first_line(output));
  if (job.waiting.ended() && (job.id.empty() || !std::isdigit(static_cast<unsigned char>(job.id.front()))))
    throw refusal(output, job.waiting.exit_code());
  return job;
}

std::string submit_without_waiting(const BatchFolder& folder) {
  const auto output = folder.root / "output" / "sbatch.txt";
  ChildProcess process = sbatch(folder, {}, output);
  while (!process.ended()) std::this_thread::sleep_for(std::chrono::milliseconds(20));
  if (process.exit_code() != 0) throw refusal(output, process.exit_code());
  return number_of(first_line(output));
}

}  // namespace tack
