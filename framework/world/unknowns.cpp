#include "framework/world/unknowns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "framework/world/world.hpp"

namespace tack {
namespace {

class FixedMotion : public Motion {
 public:
  void set_positions(std::span<const int> vertices, const VecX&, const VecX& reference, double, VecX& x) const override {
    for (const int v : vertices) vertex(x, v) = vertex(reference, v);
  }
  bool moves() const override { return false; }
};

// Motion of scalar dofs with prescribed values.
class PrescribedValues : public Motion {
 public:
  PrescribedValues(Schedule values, double length) : values_(std::move(values)), length_(length) {}
  void set_positions(std::span<const int> vertices, const VecX&, const VecX&, double t, VecX& x) const override {
    for (const int v : vertices) vertex(x, v) = Vec3(length_ * values_.at(t), 0, 0);
  }
  bool moves() const override { return !values_.constant(); }
  bool rigid() const override { return false; }  // a scalar dof is not a position

 private:
  Schedule values_;
  double length_;  // m
};

}  // namespace

std::vector<int> Unknowns::add_vector_dofs(const std::string& name, std::span<const Vec3> at, double mass) { return append(name, at, mass, 0); }

ScalarDofs Unknowns::add_scalar_dofs(const std::string& name, int count, double length, double start, double mass) {
  if (!(length > 0)) throw std::logic_error("scalar dofs need a length by which they count as displacements");
  const std::vector<Vec3> at(static_cast<size_t>(count), Vec3(length * start, 0, 0));
  ScalarDofs dofs{append(name, at, mass, length), length};
  for (const int v : dofs.vertices) world_.prescribed_motion.fix_always({v, Vec3(0, 1, 1).asDiagonal(), true});
  return dofs;
}

std::vector<int> Unknowns::append(const std::string& name, std::span<const Vec3> at, double mass, double length) {
  const int more = static_cast<int>(at.size()), first = static_cast<int>(world_.rest.size()) / 3, count = first + more;
  std::vector<int> added(at.size());
  std::iota(added.begin(), added.end(), first);
  if (added.empty()) return added;
  world_.rest.conservativeResize(3 * static_cast<Eigen::Index>(count));
  world_.mass.conservativeResize(count);
  world_.gravitational_mass.conservativeResize(count);
  for (int i = 0; i < more; ++i) {
    vertex(world_.rest, added[i]) = at[i];
    world_.mass(added[i]) = mass;
    world_.gravitational_mass(added[i]) = length > 0 ? 0 : mass;
  }
  world_.prescribed_motion.add_vertices(more);
  world_.extra_object.insert(world_.extra_object.end(), at.size(), body_);
  if (body_ >= 0) {
    auto& extra = world_.bodies[body_].extra_vertices;
    extra.insert(extra.end(), added.begin(), added.end());
  }
  world_.unknowns.push_back({owner_ + "/" + name, body_, added, length});
  return added;
}

void Unknowns::make_dependent(Dependence dependence) {
  world_.prescribed_motion.add_dependence(dependence);
  world_.constraints.add_lasting(std::move(dependence));
}

void Unknowns::fix_directions(int vertex, const Mat3& directions) { world_.prescribed_motion.fix_always({vertex, directions, false}); }

void Unknowns::fix(std::vector<int> vertices) {
  world_.own_motions.push_back(std::make_unique<FixedMotion>());
  world_.prescribed_motion.add({world_.own_motions.back().get(), std::move(vertices), "the vector dofs of " + owner_});
}

void Unknowns::prescribe(const ScalarDofs& dofs, std::span<const int> indices, const Schedule& values) {
  std::vector<int> vertices;
  for (const int i : indices) vertices.push_back(dofs.vertices[i]);
  std::sort(vertices.begin(), vertices.end());
  for (const int v : vertices) vertex(world_.rest, v) = Vec3(dofs.length * values.at(0), 0, 0);
  world_.own_motions.push_back(std::make_unique<PrescribedValues>(values, dofs.length));
  world_.prescribed_motion.add({world_.own_motions.back().get(), std::move(vertices), fmt::format("the values that {} gives", owner_)});
}

}  // namespace tack
