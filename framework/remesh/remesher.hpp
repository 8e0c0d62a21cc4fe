// Remeshing after a step: which objects get new tets, and when the next attempt is made.
#pragma once

#include "framework/core/warning.hpp"
#include "framework/remesh/new_elements.hpp"
#include "framework/scene/scene_config.hpp"
#include "framework/world/world.hpp"

namespace tack {

class Remesher {
 public:
  explicit Remesher(const SceneConfig& scene);

  // Returns better tets, if there are any, for objects whose worst tet is below their limit at the
  // end of a step. The result is stored in the history of the state: the next attempt is made
  // when the worst tet is worse by a fifth than after this one. Calls `warn` for objects without
  // improvement.
  std::vector<NewElements> exchange(const World& world, State& state,
                                    const WarningFunction& warn) const;

 private:
  const SceneConfig& scene_;
  std::vector<int> objects_;  // objects with `remesh`
};

}  // namespace tack
