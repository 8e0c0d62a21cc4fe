// Reads an experiment file into a typed experiment.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "framework/body/flowed_mesh.hpp"
#include "framework/experiment/experiment.hpp"
#include "framework/setup/initial_state.hpp"

namespace tack {

struct LoadedExperiment {
  Value root;  // as parsed, for source locations in messages
  Experiment experiment;
  // Initial state from a run; unset: as `start` says (read_initial_state.hpp).
  std::optional<InitialStateFromRun> initial_state;
  // Meshes of objects that were remeshed in a run that is resumed.
  FlowedMeshes flowed;
};

// Reads a file. `overrides`: "a.b=c". Throws InputError with file, line and remedy.
LoadedExperiment load_experiment(const std::string& path,
                                 const std::vector<std::string>& overrides);

// Binds a parsed file.
LoadedExperiment bound_experiment(Value root);

// Reads a text; `name` stands for the file in messages.
LoadedExperiment parse_experiment(const std::string& text, const std::string& name,
                                  const std::vector<std::string>& overrides = {});

}  // namespace tack
