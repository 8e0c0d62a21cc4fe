#include "framework/batch/case_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <csignal>
#include <cstring>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <thread>

#include "framework/config/read_file.hpp"
#include "framework/output/checkpoints.hpp"
#include "framework/output/folder_lock.hpp"
#include "geometry/errors.hpp"
#include "geometry/io/replace_file.hpp"
#include "geometry/run_program.hpp"

namespace tack {
namespace {

namespace fs = std::filesystem;

constexpr double heartbeat = 0.5;  // s between updates of the state of a running case
constexpr double patience = 20;  // s from the interrupt to the kill
constexpr std::uintmax_t largest_output = std::uintmax_t{1} << 30;

// Returns the end of a file, at most `size` bytes.
std::string tail(const fs::path& path, std::streamoff size) {
  std::ifstream in(path, std::ios::binary | std::ios::ate);
  if (!in) return "";
  const std::streamoff from = std::max<std::streamoff>(0, static_cast<std::streamoff>(in.tellg()) - size);
  in.seekg(from);
  return {std::istreambuf_iterator<char>(in), {}};
}

// Returns true for a run with a checkpoint; resumed, it has the bits of an uninterrupted run.
bool resumable(const BatchFolder& folder, const BatchCase& one) {
  return FolderLock::marked(folder.run(one.name)) && !newest_checkpoint_in(folder.run(one.name) / "checkpoints", true).empty();
}

// Locks the folder of a run. Waits, since processes of a killed batch end with a short delay.
FolderLock locked(const fs::path& run) {
  using namespace std::chrono_literals;
  for (int i = 0; i < 100; ++i) try {
      return FolderLock(run);
    } catch (const InputError&) {
      std::this_thread::sleep_for(20ms);
    }
  return FolderLock(run);
}

// Returns the error of a run, "error" of summary.json; "" if there is none.
std::string error_in_summary(const fs::path& run) {
  std::ifstream in(run / "summary.json");
  const nlohmann::json json = nlohmann::json::parse(in, nullptr, false);
  return json.is_object() && json.contains("error") && json["error"].is_string() ? json["error"].get<std::string>() : "";
}

}  // namespace

CaseRun::CaseRun(const std::string& program, const BatchFolder& folder, const BatchCase& one, const BatchLimits& limits)
    : program_(program), folder_(folder), case_(one), limits_(limits), process_([&] {
        // An equal digest means an interrupted run of the case, or one that is to run again.
        const bool same = read_case_state(folder.state(one.name)).digest == one.digest;
        resumed_ = same && !finished(state_of(folder, one).status) && resumable(folder, one);
        if (FolderLock::marked(folder.run(one.name))) {
          const FolderLock lock = locked(folder.run(one.name));
          if (same && !resumed_) fs::remove_all(folder.run(one.name));
        }
        replace_file(folder.scene(one.name), one.scene);
        replace_file(folder.output(one.name), "");
        if (resumed_) before_ = state_of(folder, one);
        state_ = {CaseStatus::running, one.digest, "", before_.wall_seconds, before_.cpu_seconds, before_.memory_mb};
        write_case_state(folder.state(one.name), state_);
        return start(resumed_);
      }()) {}

ChildProcess CaseRun::start(bool resume) {
  std::vector<std::string> arguments{program_, "run", folder_.scene(case_.name), "-o", folder_.run(case_.name),
                                     "--threads", fmt::format("{}", limits_.threads)};
  if (limits_.memory) arguments.insert(arguments.end(), {"--memory", fmt::format("{}", *limits_.memory)});
  if (resume) arguments.push_back("--resume");
  return {arguments, folder_.output(case_.name)};
}

bool CaseRun::ended() {
  if (state_.status != CaseStatus::running) return true;
  if (!process_.ended()) {
    if (killed_at_ >= 0 && process_.seconds() > killed_at_) {
      process_.send(SIGKILL);
    } else if (killed_at_ < 0 && process_.seconds() > limits_.time_limit.value_or(std::numeric_limits<double>::infinity())) {
      timed_out_ = true;
      interrupt();
    }
    // Keeps the state up to date for the next call, in case this program is killed.
    if (process_.seconds() > state_written_at_ + heartbeat) {
      state_written_at_ = process_.seconds();
      add_up();
      write_case_state(folder_.state(case_.name), state_);
    }
    return false;
  }
  if (resumed_ && process_.exit_code() == 2) {  // for example, a damaged checkpoint
    resumed_ = false;
    before_ = {};
    state_written_at_ = 0;
    fs::remove_all(folder_.run(case_.name));
    process_ = start(false);
    return false;
  }
  settle();
  write_case_state(folder_.state(case_.name), state_);
  return true;
}

void CaseRun::interrupt() {
  if (killed_at_ >= 0) return;
  killed_at_ = process_.seconds() + patience;
  process_.send(SIGTERM);
}

double CaseRun::fraction() const {
  const std::string end = tail(folder_.run(case_.name) / "steps.csv", 8192);
  const size_t last = end.rfind('\n');
  if (last == end.npos || last == 0) return 0;
  const size_t line = end.rfind('\n', last - 1);
  const size_t comma = end.find(',', line == end.npos ? 0 : line);
  if (line == end.npos || comma == end.npos) return 0;
  double time = 0;
  std::from_chars(end.data() + comma + 1, end.data() + last, time);
  return case_.duration > 0 ? std::clamp(time / case_.duration, 0.0, 1.0) : 0;
}

std::string CaseRun::last_output_line() const {
  const std::string text = tail(folder_.output(case_.name), 16384);
  const size_t error = text.rfind("error: ");
  if (error != text.npos) return text.substr(error + 7, text.find('\n', error) - error - 7);
  return "";
}

// Returns a hint if a crash looks as if memory had run out, which no error code says; "" otherwise.
std::string CaseRun::memory_error() const {
  if (limits_.memory && state_.memory_mb > 500 * *limits_.memory)
    return fmt::format("; it had {:.2g} of the {:.2g} GB that it may have: raise memory, or use fewer cells", state_.memory_mb / 1e3, *limits_.memory);
  if (process_.signal() == SIGKILL) return "; the machine may have run out of memory: give `memory`, so that fewer cases run side by side";
  return "";
}

void CaseRun::add_up() {
  state_.wall_seconds = before_.wall_seconds + process_.seconds();
  state_.cpu_seconds = before_.cpu_seconds + process_.cpu_seconds();
  state_.memory_mb = std::max(before_.memory_mb, process_.memory_mb());
}

void CaseRun::settle() {
  add_up();
  const fs::path run = folder_.run(case_.name);
  const int code = process_.exit_code(), signal = process_.signal();
  if (timed_out_) {
    state_.status = CaseStatus::timed_out;
    state_.error = fmt::format("not done within its time limit of {:g} s", *limits_.time_limit);
  } else if (code == 0) {
    state_.status = CaseStatus::done;
  } else if (code == 1) {
    state_.status = CaseStatus::expectation_failed;
  } else if (code == 2) {
    state_.status = CaseStatus::refused;
    state_.error = last_output_line();
  } else if (code == 3) {
    state_.status = CaseStatus::simulation_failed;
    state_.error = error_in_summary(run);
    if (state_.error.empty()) state_.error = last_output_line();
  } else if (code == 130 || killed_at_ >= 0) {
    state_.status = CaseStatus::interrupted;
  } else {
    state_.status = CaseStatus::crashed;
    state_.error = signal ? fmt::format("ended by signal {} ({})", signal, ::strsignal(signal))
                   : could_not_start(code) ? "the program could not be started: it or one of its libraries was replaced or removed meanwhile; start again"
                                             : fmt::format("ended with code {}", code);
    state_.error += memory_error();
  }
}

}  // namespace tack
