// Initial state of an experiment from an earlier run (`start`).
#pragma once

#include <string>

#include "framework/experiment/experiment.hpp"
#include "framework/output/state_file.hpp"
#include "framework/setup/initial_state.hpp"

namespace tack {

// Reads the state. `from`: a checkpoint, or the folder of a run, whose newest checkpoint is read.
// Throws InputError if there is none, or if it does not name its objects.
InitialStateFromRun read_initial_state(const std::string& from);

// Returns the state of a file with its scene; `name` stands for the file in messages.
InitialStateFromRun initial_state_of(const StateFile& file, const Experiment& experiment,
                                     const std::string& name);

}  // namespace tack
