#include "framework/world/describe_primitive.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>

namespace tack {

std::string describe_primitive(const World& world, const std::vector<int>& vertices) {
  static constexpr std::array<const char*, 4> kinds = {"vertex", "edge", "triangle", "tet"};
  const Body& body = world.bodies[world.body_of(vertices[0])];
  std::vector<int> own;
  for (const int v : vertices) own.push_back(world.index_in_body(v));
  const std::string indices = fmt::format("{}", fmt::join(own, ", "));
  return fmt::format("{} {} of '{}'", kinds[own.size() - 1], own.size() > 1 ? "(" + indices + ")" : indices, body.name);
}

}  // namespace tack
