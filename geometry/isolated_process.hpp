// Runs work in a child process. If an external library crashes, loops or takes all memory there,
// only the child ends, not the program.
//
// The child is a fork, because starting a new program takes 0.1 s and this code may be in a
// library. A fork has only the thread that forked. It is safe if the work takes no lock that
// another thread may have held (glibc restores those of malloc and files) and starts no parallel
// loop. The child ends by _exit, and its output is lost.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace tack {

struct ProcessLimits {
  // Bytes in addition to those of the program; no limit with the address sanitizer.
  std::uint64_t memory = 0;
  // s; times 20 with the address sanitizer. Processor time is that of the child alone, whatever
  // else the machine does; wall time ends a child that waits forever.
  double processor_time = 0, wall_time = 0;
};

struct ProcessResult {
  enum class End {
    answer,             // text: result of the work
    input_error,        // the work threw InputError; text: its message
    exception,          // the work threw another exception; text: its message
    no_memory,          // the memory limit was reached
    no_processor_time,  // killed at the limit of processor time
    no_wall_time,       // killed at the limit of wall time
    died                // text: reason, such as "crashed (Segmentation fault)", "ended with code 3"
  };
  End end = End::died;
  std::string text;
};

// Returns how the work ended. Throws std::runtime_error if the system refuses a process or pipe,
// and Interrupted within 0.1 s of an interrupt request. One call at a time: others wait.
ProcessResult run_isolated(const ProcessLimits& limits, const std::function<std::string()>& work);

}  // namespace tack
