#include "framework/probes/vertex_set.hpp"

#include <fmt/format.h>

#include "framework/world/world.hpp"
#include "geometry/errors.hpp"

namespace tack {

int object_index(const World& world, const std::string& name, const std::string& probe) {
  return world.index_of(name, fmt::format("probe '{}': ", probe));
}

std::vector<int> copies_of(const World& world, const std::string& name, const std::string& probe) {
  const auto copy = [beginning = name + "_"](const std::string& other) {
    return other.size() > beginning.size() && other.starts_with(beginning) && other.find_first_not_of("0123456789", beginning.size()) == std::string::npos;
  };
  std::vector<int> found;
  for (size_t i = 0; i < world.bodies.size(); ++i)
    if (world.bodies[i].name == name || copy(world.bodies[i].name)) found.push_back(static_cast<int>(i));
  if (found.empty()) object_index(world, name, probe);  // throws with the known names
  return found;
}

void require_contact(const World& world, const std::string& probe) {
  if (!world.contact) throw InputError("probe '" + probe + "': the scene has no contact section");
}

void VertexSet::prepare(const World& world, const std::string& probe) {
  const int index = object_index(world, object_, probe);
  vertices_ = select(*select_, world.selection_context(index));
}

Vec3 VertexSet::mean(const VecX& x) const {
  Vec3 sum = Vec3::Zero();
  for (const int v : vertices_) sum += vertex(x, v);
  return sum / static_cast<double>(vertices_.size());
}

}  // namespace tack
