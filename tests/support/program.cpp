#include "tests/support/program.hpp"

#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>

#include <chrono>
#include <stdexcept>
#include <thread>

extern char** environ;

namespace tack {

namespace fs = std::filesystem;

Program::Program(const fs::path& directory, const Arguments& arguments, const std::string& program) {
  const std::string out = printed_.path() / "out", err = printed_.path() / "err";
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addchdir_np(&actions, directory.c_str());
  posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, 1, out.c_str(), O_CREAT | O_WRONLY, 0600);
  posix_spawn_file_actions_addopen(&actions, 2, err.c_str(), O_CREAT | O_WRONLY, 0600);
  std::vector<std::string> words = {program};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  const int failed = ::posix_spawn(&pid_, program.c_str(), &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failed) throw std::runtime_error("cannot start " + program);
}

Program::~Program() {
  if (pid_ < 0) return;
  ::kill(pid_, SIGKILL);
  ::waitpid(pid_, nullptr, 0);
}

void Program::interrupt() { ::kill(pid_, SIGINT); }

void Program::terminate() { ::kill(pid_, SIGTERM); }
void Program::hang_up() { ::kill(pid_, SIGHUP); }

bool Program::has_child() const {
  for (const auto& thread : fs::directory_iterator("/proc/" + std::to_string(pid_) + "/task"))
    if (!file_text(thread.path() / "children").empty()) return true;
  return false;
}

int Program::threads_open_to(int signal) const {
  int open = 0;
  for (const auto& thread : fs::directory_iterator("/proc/" + std::to_string(pid_) + "/task")) {
    const std::string text = file_text(thread.path() / "status");
    const size_t at = text.find("SigBlk:");
    open += at == text.npos || !(std::stoull(text.substr(at + 7), nullptr, 16) >> (signal - 1) & 1);
  }
  return open;
}

void Program::kill() { ::kill(pid_, SIGKILL); }

ProgramResult Program::wait(std::chrono::minutes patience) {
  using namespace std::chrono_literals;
  int status = 0;
  pid_t ended = 0;
  const auto deadline = std::chrono::steady_clock::now() + TACK_PATIENCE * patience;
  while ((ended = ::waitpid(pid_, &status, WNOHANG)) == 0) {
    if (std::chrono::steady_clock::now() > deadline) ::kill(pid_, SIGKILL);
    std::this_thread::sleep_for(1ms);
  }
  pid_ = -1;
  const bool exited = ended > 0 && WIFEXITED(status);
  return {exited ? WEXITSTATUS(status) : -1, file_text(printed_.path() / "out"),
          file_text(printed_.path() / "err")};
}

ProgramResult run_tack(const fs::path& directory, const Arguments& arguments, const std::string& program,
                       std::chrono::minutes patience) {
  return Program(directory, arguments, program).wait(patience);
}

std::string file_text(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void write_file(const fs::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace tack
