// Where objects of a scene start that an earlier run has moved already: at one of its checkpoints.
#pragma once

#include <string>
#include <vector>

#include "framework/config/field.hpp"

namespace tack {

struct StartConfig {
  std::string from;                  // a checkpoint, or the folder of a run: its newest
  std::vector<std::string> objects;  // or groups; empty: all that both scenes have
  bool velocities = true;
  void fields(Fields& f);
};

}  // namespace tack
