#include "framework/batch/child_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <ctime>
#include <stdexcept>
#include <utility>

namespace tack {
namespace {

// No allocations here: another thread of this program may hold the lock of malloc forever.
[[noreturn]] void become(char* const* arguments, const char* output, pid_t parent) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(126);
  ::setpgid(0, 0);
  const int file = ::open(output, O_WRONLY | O_CREAT | O_APPEND, 0644);
  const int nothing = ::open("/dev/null", O_RDONLY);
  ::dup2(nothing, 0);
  ::dup2(file, 1);
  ::dup2(file, 2);
  sigset_t none;
  sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  ::execv(arguments[0], arguments);
  ::_exit(127);
}

}  // namespace

ChildProcess::ChildProcess(const std::vector<std::string>& arguments, const std::filesystem::path& output) {
  std::vector<char*> argv;
  for (const std::string& a : arguments) argv.push_back(const_cast<char*>(a.c_str()));
  argv.push_back(nullptr);
  const pid_t self = ::getpid();
  pid_ = ::fork();
  if (pid_ == 0) become(argv.data(), output.c_str(), self);
  if (pid_ < 0) throw std::runtime_error(fmt::format("cannot start another process ({})", std::strerror(errno)));
}

ChildProcess::ChildProcess(ChildProcess&& other) noexcept
    : pid_(std::exchange(other.pid_, -1)), started_(other.started_), ended_(other.ended_), exit_code_(other.exit_code_),
      signal_(other.signal_), cpu_seconds_(other.cpu_seconds_), memory_mb_(other.memory_mb_) {}

ChildProcess& ChildProcess::operator=(ChildProcess&& other) noexcept {
  std::swap(pid_, other.pid_);  // the destructor of `other` kills the old process
  started_ = other.started_;
  ended_ = other.ended_;
  exit_code_ = other.exit_code_;
  signal_ = other.signal_;
  cpu_seconds_ = other.cpu_seconds_;
  memory_mb_ = other.memory_mb_;
  return *this;
}

ChildProcess::~ChildProcess() {
  if (pid_ < 0) return;
  ::kill(-pid_, SIGKILL);
  ::kill(pid_, SIGKILL);
  while (::waitpid(pid_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

bool ChildProcess::ended() {
  if (pid_ < 0) return true;
  int status = 0;
  rusage used{};
  if (::wait4(pid_, &status, WNOHANG, &used) != pid_) return false;
  pid_ = -1;
  ended_ = Clock::now();
  exit_code_ = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  signal_ = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  const auto seconds = [](const timeval& t) { return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec); };
  cpu_seconds_ = seconds(used.ru_utime) + seconds(used.ru_stime);
  memory_mb_ = static_cast<double>(used.ru_maxrss) / 1024;
  return true;
}

void ChildProcess::send(int signal) {
  if (pid_ > 0) ::kill(pid_, signal);
}

double ChildProcess::cpu_seconds() const {
  clockid_t clock = 0;
  timespec used{};
  if (pid_ < 0 || ::clock_getcpuclockid(pid_, &clock) != 0 || ::clock_gettime(clock, &used) != 0) return cpu_seconds_;
  return static_cast<double>(used.tv_sec) + 1e-9 * static_cast<double>(used.tv_nsec);
}

double ChildProcess::seconds() const {
  return std::chrono::duration<double>((pid_ < 0 ? ended_ : Clock::now()) - started_).count();
}

}  // namespace tack
