#include "framework/scene/world.hpp"

#include "framework/contact/friction_term.hpp"
#include "framework/core/damping_terms.hpp"

namespace tack {

World::World() = default;
World::~World() = default;

int World::body_index(const std::string& name) const {
  for (size_t i = 0; i < bodies.size(); ++i)
    if (bodies[i].name == name) return static_cast<int>(i);
  return -1;
}

int World::body_of(int vertex) const {
  int body = 0;
  while (vertex >= bodies[body].first_vertex + bodies[body].vertex_count) ++body;
  return body;
}

}  // namespace tack
