// A number of the scene that probes are differentiated by, next to probes.csv (framework/sensitivity).
#pragma once

#include <optional>
#include <string>

#include "framework/config/field.hpp"

namespace tack {

struct GradientConfig {
  std::string key;                // its path, as of --set
  std::string as;                 // what it is called; empty: its path
  std::optional<double> step;     // by how much it is changed; unset: a millionth of it
  const std::string& name() const { return as.empty() ? key : as; }
  void fields(Fields& f);
};

}  // namespace tack
