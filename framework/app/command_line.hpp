// What the program was called with.
#pragma once

namespace tack {

// Does it, and returns the exit code. Throws InputError, SimulationError, Interrupted, and InStudies where the other program has the command.
int execute_command_line(int argc, char** argv);

}  // namespace tack
