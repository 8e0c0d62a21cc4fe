// Initial state of objects from an earlier run, at one of its checkpoints.
#pragma once

#include <string>
#include <vector>

#include "framework/config/field.hpp"

namespace tack {

struct StartConfig {
  std::string from;                  // a checkpoint, or the folder of a run, for its newest one
  std::vector<std::string> objects;  // names of objects or groups; empty: all that both scenes have
  bool velocities = true;
  void fields(Fields& f);
};

}  // namespace tack
