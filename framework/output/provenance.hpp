// Where results come from: what the program was built from and how, on what machine it ran, when, and what it was told.
#pragma once

#include <string>
#include <vector>

#include "framework/plugin/plugins.hpp"

namespace tack {

struct Build {
  std::string version;
  std::string commit;           // of the checkout, shortened; "" if it was not built in one
  bool changed_sources = false;  // tracked sources are not those of the commit
  int untracked_sources = 0;     // source files that the build had and the commit has not
  std::string compiler;          // "GNU 12.2.0"
  std::string flags;             // "Release -O3 -DNDEBUG ..."
  std::string instruction_set;   // "AVX-512, FMA": what the flags let the compiler use

  std::string revision() const;  // "0123456789ab", "0123456789ab-dirty" if the sources are others than the commit's, ""
  std::string sources() const;   // in words: "commit 0123456789ab with 1 untracked source file", "no git checkout"
};
Build this_build();

struct Machine {
  std::string host;
  std::string cpu;           // the model
  int cores = 0;             // of all processors; 0: not known
  int hardware_threads = 0;  // that the program may use at once
  std::string description() const;  // "Intel(R) Xeon(R) ..., 2 cores"
};
Machine this_machine();

struct Provenance {
  Build build;
  Machine machine;
  int threads = 0;           // that were used
  std::string date;          // when it began, "2026-01-31T23:59:59Z"
  std::string command_line;  // as a shell would take it; "" for a program that is not tack's
  std::string directory;     // where it was started
  std::vector<Plugin> plugins = {};  // that took part
};
// Of what begins now.
Provenance provenance_of(const std::string& command_line, int threads);

// Words as one line that a shell would take apart in the same way.
std::string shell_line(const std::vector<std::string>& words);

}  // namespace tack
