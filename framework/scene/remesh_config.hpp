// When the tets of an object are exchanged for better ones between steps, as the scene gives it.
#pragma once

#include "framework/config/field.hpp"

namespace tack {

struct RemeshConfig {
  double quality = 0.1;  // mean ratio of the worst tet, below which it is done
  double goal = 0.3;     // that is good enough
  void fields(Fields& f);
};

}  // namespace tack
