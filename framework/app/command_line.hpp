// The command line of the program.
#pragma once

namespace tack {

// Executes the command line and returns the exit code. Throws InputError, SimulationError and
// Interrupted, and InStudies for a command that only tack_studies has.
int execute_command_line(int argc, char** argv);

}  // namespace tack
