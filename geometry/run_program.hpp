// Runs other programs.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tack {

struct ProgramStreams {
  std::filesystem::path folder = {};  // working folder; empty: the current one
  std::filesystem::path output = {};  // file of its standard output; empty: that of this program
  bool errors_to_output = false;      // standard error goes there too
};

// Runs a program, waits for it and returns its exit code; -1 if it could not start or was killed.
// Ctrl-C ends it.
int run_program(std::vector<std::string> words, const ProgramStreams& streams = {});

// Returns true for the exit code of a program that is missing, or lacks a library: -1, or 127 of
// shells, of children without a program, and of the dynamic linker.
inline bool could_not_start(int code) { return code < 0 || code == 127; }

}  // namespace tack
