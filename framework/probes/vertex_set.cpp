#include "framework/probes/vertex_set.hpp"

#include <fmt/format.h>

#include "framework/config/nearest.hpp"
#include "framework/scene/world.hpp"
#include "geometry/errors.hpp"

namespace tack {

int object_index(const World& world, const std::string& name, const std::string& probe) {
  const int index = world.body_index(name);
  if (index >= 0) return index;
  std::vector<std::string> names;
  for (const Body& body : world.bodies) names.push_back(body.name);
  throw InputError(fmt::format("probe '{}': no object is named '{}'{}", probe, name,
                               suggestion(name, names, "objects")));
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
