#include "framework/scene/remesh_config.hpp"

namespace tack {

void RemeshConfig::fields(Fields& f) {
  f.number("quality", quality, units::none,
           "mean ratio (1: regular tet, 0: flat tet) below which tets are remeshed after the step")
      .range(0.001, 0.9);
  f.number("goal", goal, units::none, "target mean ratio: tets below it are changed until they reach it or no operation helps; others stay")
      .range(0.001, 0.9);
  f.check("goal", [this]() -> std::string { return goal > quality ? "" : "is not above `quality`, at which it begins; raise it"; });
}

}  // namespace tack
