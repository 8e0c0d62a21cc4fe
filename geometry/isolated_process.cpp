#include "geometry/isolated_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstring>
#include <fstream>
#include <mutex>
#include <new>
#include <optional>

#include "geometry/errors.hpp"
#include "geometry/interrupt.hpp"

namespace tack {
namespace {

using End = ProcessResult::End;

#ifdef __SANITIZE_ADDRESS__
constexpr bool sanitized = true;
#else
constexpr bool sanitized = false;
#endif
constexpr int time_factor = sanitized ? 20 : 1;

// Returns the byte that encodes how the work ended. The child sends it first and last; the last one shows that the message is complete.
char letter(End end) { return static_cast<char>('A' + static_cast<int>(end)); }

void limit(int resource, rlim_t most) {
  const rlimit value = {most, most};
  ::setrlimit(static_cast<__rlimit_resource>(resource), &value);
}

void set_limits(const ProcessLimits& limits) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  ::signal(SIGINT, SIG_DFL);
  ::signal(SIGTERM, SIG_DFL);
  if (::signal(SIGHUP, SIG_DFL) == SIG_IGN) ::signal(SIGHUP, SIG_IGN);  // nohup
  limit(RLIMIT_CORE, 0);
  if (sanitized) return;
  std::uint64_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  limit(RLIMIT_AS, pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE)) + limits.memory);
  const int nowhere = ::open("/dev/null", O_WRONLY);  // output of a crashing library
  ::dup2(nowhere, STDOUT_FILENO);
  ::dup2(nowhere, STDERR_FILENO);
}

ProcessResult outcome(const std::function<std::string()>& work) {
  try {
    return {End::answer, work()};
  } catch (const InputError& error) {
    return {End::input_error, error.what()};
  } catch (const std::bad_alloc&) {
    return {End::no_memory, ""};
  } catch (const std::exception& error) {
    return {End::exception, error.what()};
  }
}

[[noreturn]] void run_child(const ProcessLimits& limits, const std::function<std::string()>& work, int pipe) {
  set_limits(limits);
  const ProcessResult result = outcome(work);
  const std::string text = letter(result.end) + result.text + letter(result.end);
  for (std::size_t sent = 0; sent < text.size();) {
    const ssize_t more = ::write(pipe, text.data() + sent, text.size() - sent);
    if (more < 0 && errno != EINTR) break;
    if (more > 0) sent += static_cast<std::size_t>(more);
  }
  ::_exit(0);
}

// Returns the processor time [s] that a child has used; 0 if it has ended.
double processor_time_of(pid_t child) {
  clockid_t clock;
  timespec used = {};
  if (::clock_getcpuclockid(child, &clock) != 0 || ::clock_gettime(clock, &used) != 0) return 0;
  return static_cast<double>(used.tv_sec) + 1e-9 * static_cast<double>(used.tv_nsec);
}

struct Received {
  std::string text;
  std::optional<End> limit;  // the time limit at which the child was killed
};

// Returns all that the child sends until it ends. Kills it at a time limit or if the program is interrupted (the signal may arrive in any
// thread). Checks ten times a second.
Received receive(int pipe, pid_t child, const ProcessLimits& limits) {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  Received received;
  std::array<char, 1 << 16> buffer;
  for (;;) {
    const double wall_left = limits.wall_time * time_factor - std::chrono::duration<double>(Clock::now() - start).count();
    pollfd ready = {pipe, POLLIN, 0};
    const int event_count = ::poll(&ready, 1, static_cast<int>(std::clamp(std::ceil(1000 * wall_left), 0.0, 100.0)));
    if (event_count <= 0 && !received.limit) {
      if (wall_left <= 0) received.limit = End::no_wall_time;
      if (processor_time_of(child) > limits.processor_time * time_factor) received.limit = End::no_processor_time;
    }
    if (interrupt_requested || received.limit) ::kill(child, SIGKILL);
    else if (event_count <= 0) continue;
    const ssize_t count = ::read(pipe, buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return received;
    received.text.append(buffer.data(), static_cast<std::size_t>(count));
  }
}

ProcessResult end_of(pid_t child) {
  int status = 0;
  while (::waitpid(child, &status, 0) < 0)
    if (errno != EINTR) return {End::died, "ended for an unknown reason"};
  if (!WIFSIGNALED(status)) return {End::died, fmt::format("ended with code {}", WEXITSTATUS(status))};
  const int signal = WTERMSIG(status);
  if (signal == SIGKILL) return {End::died, "was killed from outside (the system may be out of memory)"};
  return {End::died, fmt::format("crashed ({})", ::strsignal(signal))};
}

}  // namespace

ProcessResult run_isolated(const ProcessLimits& limits, const std::function<std::string()>& work) {
  static std::mutex one_at_a_time;  // otherwise children would keep each other's pipes open
  const std::scoped_lock lock(one_at_a_time);
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error(fmt::format("no pipe ({})", std::strerror(errno)));
  const pid_t child = ::fork();
  if (child == 0) run_child(limits, work, ends[1]);
  ::close(ends[1]);
  if (child < 0) {
    ::close(ends[0]);
    throw std::runtime_error(fmt::format("no process ({})", std::strerror(errno)));
  }
  const auto [text, time_limit] = receive(ends[0], child, limits);
  ::close(ends[0]);
  ProcessResult end = end_of(child);
  if (time_limit) end = {*time_limit, ""};
  if (interrupt_requested) throw Interrupted();
  if (text.size() < 2 || text.front() != text.back()) return end;
  for (const End sent : {End::answer, End::input_error, End::exception, End::no_memory})
    if (text.front() == letter(sent)) return {sent, text.substr(1, text.size() - 2)};
  return end;
}

}  // namespace tack
