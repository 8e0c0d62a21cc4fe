// Runs work in a separate process: if an external library crashes, loops or takes all memory there,
// this ends that process and not the program.
//
// A fork, not a new program: this is a library, and starting a program again takes 0.1 s. A fork of
// a program with threads has only the one that forked; it is safe if the work takes no lock that
// another thread could have held (glibc mends its own for malloc and files) and starts no parallel
// loop. It leaves by _exit, and what it prints is lost.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace tack {

struct ProcessLimits {
  // Bytes more than the program has; no limit with the address sanitizer.
  std::uint64_t memory = 0;
  double processor_time = 0;  // s; with the address sanitizer 20 times as long
  double wall_time = 0;       // s; likewise
};

struct ProcessResult {
  enum class End {
    answer,       // text: what the work returned
    input_error,  // it threw InputError; text: the message
    exception,    // it threw something else; text: the message
    no_memory,    // it asked for more than it may have
    no_time,      // killed
    died          // text: how, such as "crashed (Segmentation fault)", "ended with code 3"
  };
  End end = End::died;
  std::string text;
};

// Throws std::runtime_error if there is no process or pipe to be had, and Interrupted, within a
// tenth of a second, if that is asked for. One at a time: others wait.
ProcessResult run_isolated(const ProcessLimits& limits, const std::function<std::string()>& work);

}  // namespace tack
