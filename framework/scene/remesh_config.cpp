#include "framework/scene/remesh_config.hpp"

namespace tack {

void RemeshConfig::fields(Fields& f) {
  f.number("quality", quality, units::none,
           "mean ratio of a tet, 1 of a regular one and 0 of a flat one, below which those that are poor are exchanged after the step")
      .range(0.001, 0.9);
  f.number("goal", goal, units::none, "mean ratio that is good enough: tets below it are changed until they have it, or nothing helps any more; others stay")
      .range(0.001, 0.9);
  f.check("goal", [this]() -> std::string { return goal > quality ? "" : "is not above `quality`, at which it begins; raise it"; });
}

}  // namespace tack
