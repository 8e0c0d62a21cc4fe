// Provenance of results: build, machine, date, command line and plugins.
#pragma once

#include <string>
#include <vector>

#include "framework/plugin/plugins.hpp"

namespace tack {

struct Build {
  std::string version;
  std::string commit;            // of the checkout, shortened; "" if built outside of one
  bool changed_sources = false;  // tracked sources differ from the commit
  int untracked_sources = 0;     // source files of the build that the commit lacks
  std::string compiler;          // "GNU 12.2.0"
  std::string flags;             // "Release -O3 -DNDEBUG ..."
  std::string instruction_set;   // "AVX-512, FMA": as enabled by the flags

  // "0123456789ab", "0123456789ab-dirty" if sources differ from the commit, ""
  std::string revision() const;
  // In words: "commit 0123456789ab with 1 untracked source file", "no git checkout".
  std::string sources() const;
};
Build this_build();

struct Machine {
  std::string host;
  std::string cpu;                  // the model
  int cores = 0;                    // of all processors; 0: unknown
  int hardware_threads = 0;         // available to the program
  std::string description() const;  // "Intel(R) Xeon(R) ..., 2 cores"
};
Machine this_machine();

struct Provenance {
  Build build;
  Machine machine;
  int threads = 0;                   // number of threads used
  std::string date;                  // start, "2026-01-31T23:59:59Z"
  std::string command_line;          // as for a shell; "" for a program that is not tack's
  std::string directory;             // working directory at the start
  std::vector<Plugin> plugins = {};  // loaded plugins
};
// Returns the provenance of a run that begins now.
Provenance provenance_of(const std::string& command_line, int threads);

// Joins words into one line that a shell splits into the same words.
std::string shell_line(const std::vector<std::string>& words);

}  // namespace tack
