#include "framework/stepping/moving_components.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "framework/contact/contact_system.hpp"
#include "framework/core/disjoint_sets.hpp"
#include "geometry/broad_phase/overlap_pairs.hpp"

namespace tack {
namespace {

// Filter for overlap_pairs: components whose relative displacement is too large.
struct Passing {
  const MovingComponents& parts;
  const CollidingObjects& colliding;
  double fraction, least;

  bool accept(int a, int b) const {
    const MovingComponent &one = parts[a], &other = parts[b];
    const double size = smaller_size(one, other, least);
    return one.displacement_against(other, size) > fraction * size &&
           colliding.allows(one.object, other.object);
  }
  std::array<int, 2> pair(int a, int b) const { return {a, b}; }
};

}  // namespace

MovingComponents::MovingComponents(const World& world) : world_(world), part_of_(static_cast<size_t>(world.rest.size()) / 3, -1) {
  const ContactSurface& surface = world.contact->surface();
  DisjointSets sets(static_cast<int>(part_of_.size()));
  for (const Edge& e : surface.mesh.edges) sets.join(e[0], e[1]);
  for (const Body& body : world.bodies) {
    for (const Tet& t : body.tets)
      for (int i = 1; i < 4; ++i) sets.join(t[0], t[i]);
    if (body.frame.empty()) continue;
    for (int i = 1; i < body.vertex_count; ++i) sets.join(body.first_vertex, body.first_vertex + i);
  }
  std::vector<int> number(part_of_.size(), -1);
  for (const int v : surface.mesh.vertices) {
    int& part = number[sets.find(v)];
    if (part < 0) {
      part = static_cast<int>(parts_.size());
      const int object = surface.mesh.vertex_object[v];
      parts_.push_back({object, 2 * (surface.is_particle(std::array{v}) ? surface.particle_radius[object] : 0), {}, {}});
    }
    part_of_[v] = part;
  }
}

void MovingComponents::move(const VecX& x, const VecX& y) {
  for (MovingComponent& part : parts_) part = {part.object, part.width, {}, {}};
  std::vector<int> count(parts_.size(), 0);
  // First the sums of ways, and of their squares.
  for (const int v : world_.contact->surface().mesh.vertices) {
    MovingComponent& part = parts_[part_of_[v]];
    const Vec3 way = vertex(y, v) - vertex(x, v);
    part.place.include(Vec3(vertex(x, v)));
    part.way.include(way);
    part.mean += way;
    part.deviation += way.squaredNorm();
    ++count[part_of_[v]];
  }
  for (size_t i = 0; i < parts_.size(); ++i) {
    MovingComponent& part = parts_[i];
    part.mean /= count[i];
    part.deviation = std::sqrt(std::max(0.0, part.deviation / count[i] - part.mean.squaredNorm()));
  }
}

// Returns false if no component can have moved that far against another.
bool MovingComponents::anything_moves(double fraction, double least) const {
  Aabb ways;
  double smallest = std::numeric_limits<double>::infinity();
  for (const MovingComponent& part : parts_) {
    ways.include(part.way);
    smallest = std::min(smallest, part.size());
  }
  return parts_.size() > 1 && (ways.hi - ways.lo).norm() > fraction * std::max(smallest, least);
}

std::vector<std::array<int, 2>> MovingComponents::tunnelling_pairs(double fraction, double least) const {
  std::vector<std::array<int, 2>> pairs;
  if (!anything_moves(fraction, least)) return pairs;
  std::vector<Aabb> swept;
  swept.reserve(parts_.size());
  for (const MovingComponent& part : parts_) {
    swept.push_back(part.swept());
    swept.back().inflate(part.width / 2);
  }
  overlap_pairs(Bvh(swept), Passing{*this, world_.contact->colliding(), fraction, least}, pairs);
  return pairs;
}

}  // namespace tack
