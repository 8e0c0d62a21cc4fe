// Quality criteria for remeshing an object between steps, as in the scene file.
#pragma once

#include "framework/config/field.hpp"

namespace tack {

struct RemeshConfig {
  double quality = 0.1;  // mean ratio of the worst tetrahedron, below which the object is remeshed
  double goal = 0.3;     // mean ratio at which remeshing stops
  void fields(Fields& f);
};

}  // namespace tack
