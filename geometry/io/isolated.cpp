#include "geometry/io/isolated.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <fstream>
#include <mutex>
#include <new>

#include "geometry/errors.hpp"
#include "geometry/io/mesh_bytes.hpp"

namespace tack {
namespace {

namespace fs = std::filesystem;

#ifdef __SANITIZE_ADDRESS__
constexpr bool sanitized = true;
#else
constexpr bool sanitized = false;
#endif

// The first byte of what the child sends; the last is the same again, as a sign that it came to its end.
constexpr char has_mesh = 'M', has_error = 'E';

std::uintmax_t size_of(const fs::path& path) {
  std::error_code unknown;
  const std::uintmax_t size = fs::file_size(path, unknown);
  return unknown ? 0 : size;
}

rlim_t seconds_for(const fs::path& path) { return (5 + size_of(path) / (256 << 10)) * (sanitized ? 20 : 1); }

void limit(int resource, rlim_t most) {
  const rlimit value = {most, most};
  ::setrlimit(static_cast<__rlimit_resource>(resource), &value);
}

void set_limits(const fs::path& path) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_CPU, seconds_for(path));
  if (sanitized) return;
  std::uintmax_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  const auto present = pages * static_cast<std::uintmax_t>(::sysconf(_SC_PAGESIZE));
  limit(RLIMIT_AS, present + (std::uintmax_t(1) << 30) + 64 * size_of(path));
  const int nowhere = ::open("/dev/null", O_WRONLY);  // a crashing library's last words
  ::dup2(nowhere, STDOUT_FILENO);
  ::dup2(nowhere, STDERR_FILENO);
}

std::string answer(const fs::path& path, MeshReader read) {
  try {
    return has_mesh + bytes_of(read(path)) + has_mesh;
  } catch (const InputError& error) {
    return has_error + std::string(error.what()) + has_error;
  } catch (const std::bad_alloc&) {
    return has_error + path.string() + ": needs far more memory to be read than its size explains: it is damaged, "
           "export it again" + has_error;
  } catch (const std::exception& error) {
    return has_error + path.string() + ": cannot be read (" + error.what() + "): export it again" + has_error;
  }
}

[[noreturn]] void be_child(const fs::path& path, MeshReader read, int pipe) {
  set_limits(path);
  const std::string text = answer(path, read);
  for (std::size_t sent = 0; sent < text.size();) {
    const ssize_t more = ::write(pipe, text.data() + sent, text.size() - sent);
    if (more < 0 && errno != EINTR) break;
    if (more > 0) sent += static_cast<std::size_t>(more);
  }
  ::_exit(0);
}

// What the child sends until it ends. A child that waits for ever has used no processor time: hence a limit in
// wall time too, ten times as long.
std::string receive(int pipe, pid_t child, rlim_t seconds) {
  using Clock = std::chrono::steady_clock;
  const auto deadline = Clock::now() + std::chrono::seconds(10 * seconds);
  std::string text;
  std::array<char, 1 << 16> buffer;
  for (;;) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now()).count();
    pollfd ready = {pipe, POLLIN, 0};
    const int some = ::poll(&ready, 1, static_cast<int>(std::clamp<long long>(left, 0, 1 << 30)));
    if (some < 0 && errno == EINTR) continue;
    if (some <= 0) ::kill(child, SIGKILL);
    const ssize_t count = ::read(pipe, buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return text;
    text.append(buffer.data(), static_cast<std::size_t>(count));
  }
}

std::string end_of(pid_t child) {
  int status = 0;
  while (::waitpid(child, &status, 0) < 0)
    if (errno != EINTR) return "ended for an unknown reason";
  if (!WIFSIGNALED(status)) return fmt::format("ended with code {}", WEXITSTATUS(status));
  const int signal = WTERMSIG(status);
  if (signal == SIGXCPU || signal == SIGKILL) return "did not come to an end";
  return fmt::format("crashed ({})", ::strsignal(signal));
}

}  // namespace

Mesh read_isolated(const fs::path& path, MeshReader read) {
  static std::mutex one_at_a_time;  // or children would hold each other's pipes open
  const std::scoped_lock lock(one_at_a_time);
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0)
    throw InputError(fmt::format("{}: no pipe to read it through ({})", path.string(), std::strerror(errno)));
  const pid_t child = ::fork();
  if (child == 0) be_child(path, read, ends[1]);
  ::close(ends[1]);
  if (child < 0) {
    ::close(ends[0]);
    throw InputError(fmt::format("{}: no process to read it in ({})", path.string(), std::strerror(errno)));
  }
  const std::string text = receive(ends[0], child, seconds_for(path));
  ::close(ends[0]);
  const std::string end = end_of(child);
  const bool whole = text.size() > 1 && text.front() == text.back();
  const std::string_view content = whole ? std::string_view(text).substr(1, text.size() - 2) : std::string_view();
  if (whole && text.front() == has_error) throw InputError(std::string(content));
  std::optional<Mesh> mesh;
  if (whole && text.front() == has_mesh) mesh = mesh_from(content);
  if (mesh) return std::move(*mesh);
  throw InputError(fmt::format("{}: the library that reads such files {} on this one: it is damaged, export it again",
                               path.string(), end));
}

}  // namespace tack
