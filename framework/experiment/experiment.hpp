// The typed experiment file: every key with its default. It is a specification:
// built_experiment.hpp builds it, and objects with state are instances made from it (instance_of,
// config/bind.hpp).
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "framework/core/minimizer.hpp"
#include "framework/output/expectations.hpp"
#include "framework/output/output_config.hpp"
#include "framework/output/probe.hpp"
#include "framework/scene/scene_config.hpp"
#include "framework/stepping/time_config.hpp"

namespace tack {

struct Experiment : SceneConfig {
  std::string name;
  std::string about;
  std::vector<std::string> plugins;            // absolute paths; loaded
  std::map<std::string, Quantity> parameters;  // already substituted in all other values
  TimeConfig time;
  std::unique_ptr<const Minimizer> solver = Registry<Minimizer>::make("projected_newton");
  std::vector<std::unique_ptr<const Probe>> probes;
  OutputConfig output;
  std::vector<Expectation> expect;
  void fields(Fields& f);
};

}  // namespace tack
