#include "framework/stepping/obstacle.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>

#include "framework/contact/contact_system.hpp"
#include "framework/world/describe_primitive.hpp"
#include "geometry/broad_phase/candidate_kinds.hpp"

namespace tack {
namespace {

// Returns the objects that have candidates with object a, ascending.
std::vector<int> objects_near(const ContactSystem& contact, int a) {
  const CollisionMesh& mesh = contact.surface().mesh;
  std::vector<int> near;
  const auto add = [&](int v, int w) {
    const int i = mesh.vertex_object[v], j = mesh.vertex_object[w];
    if (i == a) near.push_back(j);
    else if (j == a) near.push_back(i);
  };
  for_each_kind(mesh, contact.candidates(), [&](const auto& kind) {
    for (const auto& pair : kind.pairs) add(kind.first(pair)[0], kind.second(pair)[0]);
  });
  std::sort(near.begin(), near.end());
  near.erase(std::unique(near.begin(), near.end()), near.end());
  return near;
}

// Returns the object nearest to object a; -1 if none is within the contact range.
int nearest_object(const ContactSystem& contact, const VecX& x, int a) {
  const CollisionMesh& mesh = contact.surface().mesh;
  int nearest = -1;
  double smallest = std::numeric_limits<double>::infinity();
  for (const int b : objects_near(contact, a)) {
    const double d = smallest_gaps(contact.surface(), contact.pairs(), candidates_between(mesh, contact.candidates(), a, b), x).of_all;
    if (d < smallest) smallest = d, nearest = b;
  }
  return nearest;
}

}  // namespace

std::string describe_blocker(const World& world, const std::vector<std::unique_ptr<StepFilter>>& filters,
                             const VecX& x, const VecX& p) {
  std::optional<Blocker> worst;
  for (const auto& filter : filters)
    if (auto found = filter->blocker(x, p); found && !(worst && worst->step <= found->step)) worst = std::move(found);
  if (!worst) return "";
  const std::string cut = fmt::format("cut to {:.2g} of its length ({:.2g} m) by {}", worst->step,
                                      p.lpNorm<Eigen::Infinity>(), describe_primitive(world, worst->first));
  if (worst->second.empty()) return cut + ", which it would crush";
  return fmt::format("{} and {}, {:.2g} m apart", cut, describe_primitive(world, worst->second), worst->gap);
}

std::string describe_obstacle(const World& world, const VecX& x, int v, double distance) {
  const int a = world.body_of(v);
  const std::string& name = world.bodies[a].name;
  const std::string remainder = fmt::format("vertex {} of '{}' is still {:.3g} m short of its target",
                                       world.index_in_body(v), name, distance);
  const int b = world.contact ? nearest_object(*world.contact, x, a) : -1;
  if (b < 0) return fmt::format("the prescribed motion deforms '{}' too far: {}", name, remainder);
  return fmt::format("the prescribed motion drives '{}' into {}: {}", name,
                     a == b ? "itself" : "'" + world.bodies[b].name + "'", remainder);
}

}  // namespace tack
