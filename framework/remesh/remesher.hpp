// Which objects' tets are exchanged after a step, and when it is tried again.
#pragma once

#include "framework/core/warning.hpp"
#include "framework/remesh/new_elements.hpp"
#include "framework/scene/scene_config.hpp"
#include "framework/world/world.hpp"

namespace tack {

class Remesher {
 public:
  explicit Remesher(const SceneConfig& scene);

  // Of the objects whose worst tet is below what they ask for, at a state that a step has ended with: better tets where there are any. What came of it is
  // noted in the state's history, so that it is tried again only when the worst tet is worse by a fifth than what it was left with; `warn` is told of
  // objects that are no better for it.
  std::vector<NewElements> exchange(const World& world, State& state, const WarningFunction& warn) const;

 private:
  const SceneConfig& scene_;
  std::vector<int> objects_;  // that ask for it
};

}  // namespace tack
