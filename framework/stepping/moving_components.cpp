#include "framework/stepping/moving_components.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "framework/contact/contact_system.hpp"
#include "framework/core/disjoint_sets.hpp"
#include "geometry/broad_phase/overlap_pairs.hpp"

namespace tack {
namespace {

// Filter for overlap_pairs: pairs of components whose relative displacement is too large.
struct FastPairs {
  const MovingComponents& components;
  const CollidingObjects& colliding;
  double fraction, least;

  bool accept(int a, int b) const {
    const MovingComponent &one = components[a], &other = components[b];
    const double size = smaller_size(one, other, least);
    return one.displacement_against(other, size) > fraction * size &&
           colliding.allows(one.object, other.object);
  }
  std::array<int, 2> pair(int a, int b) const { return {a, b}; }
};

}  // namespace

MovingComponents::MovingComponents(const World& world) : world_(world), component_of_(static_cast<size_t>(world.rest.size()) / 3, -1) {
  const ContactSurface& surface = world.contact->surface();
  DisjointSets sets(static_cast<int>(component_of_.size()));
  for (const Edge& e : surface.mesh.edges) sets.join(e[0], e[1]);
  for (const Body& body : world.bodies) {
    for (const Tet& t : body.tets)
      for (int i = 1; i < 4; ++i) sets.join(t[0], t[i]);
    if (body.frame.empty()) continue;
    for (int i = 1; i < body.vertex_count; ++i) sets.join(body.first_vertex, body.first_vertex + i);
  }
  std::vector<int> number(component_of_.size(), -1);
  for (const int v : surface.mesh.vertices) {
    int& component = number[sets.find(v)];
    if (component < 0) {
      component = static_cast<int>(components_.size());
      const int object = surface.mesh.vertex_object[v];
      components_.push_back({object, 2 * (surface.is_particle(std::array{v}) ? surface.particle_radius[object] : 0), {}, {}});
    }
    component_of_[v] = component;
  }
}

void MovingComponents::move(const VecX& x, const VecX& y) {
  for (MovingComponent& component : components_) component = {component.object, component.width, {}, {}};
  std::vector<int> count(components_.size(), 0);
  // `mean` and `deviation` first hold the sums of the displacements and of their squares.
  for (const int v : world_.contact->surface().mesh.vertices) {
    MovingComponent& component = components_[component_of_[v]];
    const Vec3 displacement = vertex(y, v) - vertex(x, v);
    component.box.include(Vec3(vertex(x, v)));
    component.displacement.include(displacement);
    component.mean += displacement;
    component.deviation += displacement.squaredNorm();
    ++count[component_of_[v]];
  }
  for (size_t i = 0; i < components_.size(); ++i) {
    MovingComponent& component = components_[i];
    component.mean /= count[i];
    component.deviation = std::sqrt(std::max(0.0, component.deviation / count[i] - component.mean.squaredNorm()));
  }
}

// Returns false if no relative displacement can exceed `fraction` of the smaller size.
bool MovingComponents::anything_moves(double fraction, double least) const {
  Aabb displacements;
  double smallest = std::numeric_limits<double>::infinity();
  for (const MovingComponent& component : components_) {
    displacements.include(component.displacement);
    smallest = std::min(smallest, component.size());
  }
  return components_.size() > 1 && (displacements.hi - displacements.lo).norm() > fraction * std::max(smallest, least);
}

std::vector<std::array<int, 2>> MovingComponents::tunnelling_pairs(double fraction, double least) const {
  std::vector<std::array<int, 2>> pairs;
  if (!anything_moves(fraction, least)) return pairs;
  std::vector<Aabb> swept;
  swept.reserve(components_.size());
  for (const MovingComponent& component : components_) {
    swept.push_back(component.swept());
    swept.back().inflate(component.width / 2);
  }
  overlap_pairs(Bvh(swept), FastPairs{*this, world_.contact->colliding(), fraction, least}, pairs);
  return pairs;
}

}  // namespace tack
