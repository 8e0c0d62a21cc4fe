// The program with given arguments, in a fork of this process: a crash ends only the fork, and the
// libraries need not be loaded again, which takes ten times as long as most of what is tried.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tack {

struct ForkedResult {
  int exit_code = -1;
  int signal = 0;       // that ended it
  bool hung = false;    // ended by us, after the limit
  std::string printed;  // output and errors
};

// Runs `tack arguments...` in a working directory, with at most `seconds` of processor time, ten
// times as much of wall time (should it wait for ever), and 8 GiB of memory (with the address
// sanitizer: in one piece).
ForkedResult run_forked(const std::filesystem::path& directory,
                        const std::vector<std::string>& arguments, double seconds);

}  // namespace tack
