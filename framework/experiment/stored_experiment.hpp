// Conversion between an experiment and a state file (framework/output/state_file.hpp).
#pragma once

#include <string>

#include "framework/experiment/load_experiment.hpp"
#include "framework/output/state_file.hpp"

namespace tack {

// Returns the experiment's part of a state file. Reads the mesh files of a problem once more.
StateFile state_file_of(StateFile::Kind kind, const Experiment& experiment);

// Returns the experiment of a state file, with its meshes; `name` stands for the file in messages.
// overrides: of its scene, "a.b=c".
LoadedExperiment experiment_of(const StateFile& file, const std::string& name,
                               const std::vector<std::string>& overrides = {});

}  // namespace tack
