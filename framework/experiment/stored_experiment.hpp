// An experiment in the file of a state (framework/output/state_file.hpp), and from it.
#pragma once

#include <string>

#include "framework/experiment/load_experiment.hpp"
#include "framework/output/state_file.hpp"

namespace tack {

// The experiment's part of a file. Reads the mesh files of a problem once more.
StateFile state_file_of(StateFile::Kind kind, const Experiment& experiment);

// The experiment of a file, with its meshes; `name` stands for the file in messages.
LoadedExperiment experiment_of(const StateFile& file, const std::string& name);

}  // namespace tack
