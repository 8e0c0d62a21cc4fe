// A program that runs beside this one: in a group of its own, so that Ctrl-C reaches it only through us, and killed by the kernel
// if we die first.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

namespace tack {

class ChildProcess {
 public:
  // What it prints goes to the file `output`. From the main thread, as the kernel ends it together with the thread that made it. Throws
  // std::runtime_error if there is no process to be had.
  ChildProcess(const std::vector<std::string>& arguments, const std::filesystem::path& output);
  ~ChildProcess();  // kills it
  ChildProcess(ChildProcess&& other) noexcept;
  ChildProcess& operator=(ChildProcess&& other) noexcept;  // kills the one that was there

  bool ended();            // does not wait
  void send(int signal);   // nothing if it has ended
  double seconds() const;  // since its start, or of its life
  double cpu_seconds() const;  // likewise, of all its threads

  // Of one that ended: its exit code, or the signal that ended it, 0 if none did.
  int exit_code() const { return exit_code_; }
  int signal() const { return signal_; }
  double memory_mb() const { return memory_mb_; }  // most that was resident

 private:
  using Clock = std::chrono::steady_clock;
  pid_t pid_ = -1;  // -1: it has ended
  Clock::time_point started_ = Clock::now(), ended_;
  int exit_code_ = -1, signal_ = 0;
  double cpu_seconds_ = 0, memory_mb_ = 0;
};

}  // namespace tack
