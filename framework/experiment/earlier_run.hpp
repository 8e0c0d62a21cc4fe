// The state of an earlier run, for an experiment that starts from it (`start`).
#pragma once

#include <string>

#include "framework/experiment/experiment.hpp"
#include "framework/output/state_file.hpp"
#include "framework/setup/initial_state.hpp"

namespace tack {

// `from`: a checkpoint, or the folder of a run: its newest. Throws InputError if there is none, or it does not tell its objects.
InitialStateFromRun state_of_run(const std::string& from);

// That of a file and its scene; `name` stands for the file in messages.
InitialStateFromRun initial_state_of(const StateFile& file, const Experiment& experiment, const std::string& name);

}  // namespace tack
