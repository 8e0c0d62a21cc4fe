// From a file on disk to a typed experiment.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "framework/body/flowed_mesh.hpp"
#include "framework/experiment/experiment.hpp"
#include "framework/setup/initial_state.hpp"

namespace tack {

struct LoadedExperiment {
  Value root;  // as parsed, for places in messages
  Experiment experiment;
  std::optional<InitialStateFromRun> earlier;  // where it starts; unset: as `start` says (earlier_run.hpp)
  FlowedMeshes flowed;  // of objects that were meshed anew in a run that is gone on with
};

// `overrides` are "a.b=c". Throws InputError with file, line and remedy.
LoadedExperiment load_experiment(const std::string& path, const std::vector<std::string>& overrides);

// The same of what was parsed.
LoadedExperiment bound_experiment(Value root);

// The same of a text; `name` stands for the file in messages.
LoadedExperiment parse_experiment(const std::string& text, const std::string& name, const std::vector<std::string>& overrides = {});

}  // namespace tack
