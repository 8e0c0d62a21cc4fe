// A scene parameter by which probes are differentiated (framework/sensitivity).
#pragma once

#include <optional>
#include <string>

#include "framework/config/field.hpp"

namespace tack {

struct GradientConfig {
  std::string key;             // dotted path, as of --set
  std::string as;              // name in results; empty: the path
  std::optional<double> step;  // step of the parameter; unset: a millionth of it
  const std::string& name() const { return as.empty() ? key : as; }
  void fields(Fields& f);
};

}  // namespace tack
