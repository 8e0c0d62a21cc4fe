// A child process in its own process group, so that Ctrl-C reaches it only through this program;
// the kernel kills it if this program dies first.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

namespace tack {

class ChildProcess {
 public:
  // Starts the program; its output goes to the file `output`. Call it from the main thread: the
  // kernel kills the child when the thread that started it ends. Throws std::runtime_error if no
  // process can be created.
  ChildProcess(const std::vector<std::string>& arguments, const std::filesystem::path& output);
  ~ChildProcess();  // kills it
  ChildProcess(ChildProcess&& other) noexcept;
  ChildProcess& operator=(ChildProcess&& other) noexcept;  // kills its old process

  bool ended();                // does not wait
  void send(int signal);       // no effect on an ended process
  double seconds() const;      // since its start, or until its end
  double cpu_seconds() const;  // CPU time of all its threads so far, or in total

  // Exit code of an ended process, and the signal that ended it; 0 if none did.
  int exit_code() const { return exit_code_; }
  int signal() const { return signal_; }
  double memory_mb() const { return memory_mb_; }  // peak resident memory

 private:
  using Clock = std::chrono::steady_clock;
  pid_t pid_ = -1;  // -1: it has ended
  Clock::time_point started_ = Clock::now(), ended_;
  int exit_code_ = -1, signal_ = 0;
  double cpu_seconds_ = 0, memory_mb_ = 0;
};

}  // namespace tack
