// The subcommands of the program, one file each. Each adds itself to the command line and, when
// chosen, sets the exit code: 0 done, 1 an expectation failed, 2 bad input, 3 the simulation failed,
// 130 interrupted.
#pragma once

#include <CLI/CLI.hpp>

namespace tack {

void add_run_command(CLI::App& app, int& exit_code);
void add_compare_command(CLI::App& app, int& exit_code);
void add_check_command(CLI::App& app, int& exit_code);
void add_list_command(CLI::App& app, int& exit_code);
void add_mesh_command(CLI::App& app, int& exit_code);

inline constexpr int exit_done = 0, exit_expectation_failed = 1, exit_bad_input = 2,
                     exit_simulation_failed = 3, exit_interrupted = 130;

}  // namespace tack
