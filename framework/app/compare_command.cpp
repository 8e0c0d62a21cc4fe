// tack compare: speed against error of several solvers on the same problems.
#include <fmt/format.h>

#include <cstdio>

#include "framework/app/commands.hpp"
#include "framework/app/thread_limit.hpp"
#include "framework/compare/compare_run.hpp"

namespace tack {

int compare_command(const CompareOptions& options) {
  const ThreadLimit threads(options.threads);
  const auto print = [&](const std::string& line) {
    if (!options.quiet) fmt::print("{}\n", line);
    std::fflush(stdout);
  };
  const std::filesystem::path folder =
      run_comparison({options.file.file, overrides_with_plugins(options.file), options.output, provenance_of(options.command_line, threads.count())}, print);
  print("results in " + folder.string());
  return exit_done;
}

}  // namespace tack
