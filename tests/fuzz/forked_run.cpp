#include "tests/fuzz/forked_run.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <thread>

#include "tests/support/program.hpp"
#include "tests/support/silence.hpp"

int tack_main(int argc, char** argv);  // that of framework/app/main.cpp

#ifdef __SANITIZE_ADDRESS__
// A limit of the address space is none for the address sanitizer, whose shadow is larger than any: it limits what is
// asked for at once.
extern "C" const char* __asan_default_options() { return "allocator_may_return_null=1:max_allocation_size_mb=8192"; }
#endif

namespace tack {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void be_program(const fs::path& directory, const std::vector<std::string>& arguments, const fs::path& printed,
                             rlim_t processor_time) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  ::setpgid(0, 0);
  const int out = ::open(printed.c_str(), O_CREAT | O_WRONLY | O_TRUNC, 0600);
  ::dup2(::open("/dev/null", O_RDONLY), 0);
  ::dup2(out, 1);
  ::dup2(out, 2);
  const rlimit time = {processor_time, processor_time};
  ::setrlimit(RLIMIT_CPU, &time);
#ifndef __SANITIZE_ADDRESS__
  const rlimit memory = {rlim_t(8) << 30, rlim_t(8) << 30}, core = {0, 0};
  ::setrlimit(RLIMIT_AS, &memory);
  ::setrlimit(RLIMIT_CORE, &core);
#endif
  if (::chdir(directory.c_str()) != 0) ::_exit(126);
  std::vector<std::string> words = {"tack"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  const int code = tack_main(static_cast<int>(words.size()), argv.data());
  std::fflush(nullptr);
  ::_exit(code);
}

}  // namespace

ForkedResult run_forked(const fs::path& directory, const std::vector<std::string>& arguments, double seconds) {
  using Clock = std::chrono::steady_clock;
  static const TemporaryFolder folder;
  const fs::path printed = folder.path() / "printed";
  const auto deadline = Clock::now() + std::chrono::duration<double>(10 * seconds * TACK_PATIENCE);
  const pid_t child = ::fork();
  if (child == 0) be_program(directory, arguments, printed, static_cast<rlim_t>(seconds * TACK_PATIENCE));
  ForkedResult result;
  int status = 0;
  const std::chrono::microseconds longest(5000);
  for (auto pause = longest / 25; ::waitpid(child, &status, WNOHANG) == 0; pause = std::min(pause * 2, longest)) {
    if (!result.hung && Clock::now() > deadline) {
      result.hung = true;
      ::kill(-child, SIGKILL);
    }
    std::this_thread::sleep_for(pause);
  }
  if (WIFEXITED(status)) result.exit_code = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) result.signal = WTERMSIG(status);
  result.hung = result.hung || result.signal == SIGXCPU;
  result.printed = file_text(printed);
  return result;
}

}  // namespace tack
