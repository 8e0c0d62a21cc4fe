#include "framework/contact/points/contact_spins.hpp"

#include <Eigen/Geometry>
#include <stdexcept>

namespace tack {

void ContactSpins::Columns::add(int scalar_dof, const Vec3& direction) {
  for (int i = 0; i < count; ++i)
    if (scalar_dofs[i] == scalar_dof) {
      directions[i] += direction;
      return;
    }
  if (count == capacity) throw std::logic_error("a contact point has more rotations than ContactSpins::Columns holds");
  scalar_dofs[count] = scalar_dof;
  directions[count++] = direction;
}

void ContactSpins::add_particle(int vertex, const std::array<int, 3>& arcs, double lever) {
  particle_[vertex] = arcs;
  lever_[vertex] = lever;
  any_ = true;
}

void ContactSpins::add_rod(const Edge& edge, int arc, double lever) {
  rods_[edge[0]].push_back({edge[1], arc, lever});
  rods_[edge[1]].push_back({edge[0], arc, -lever});
  any_ = true;
}

void ContactSpins::append(std::span<const int> vertices, const Vec3& normal, const VecX& x, Columns& columns) const {
  if (vertices.size() > 2) return;
  const int v = vertices[0];
  const auto add_edge = [&](const RodEdge& edge, double weight) {
    columns.add(edge.arc, weight * edge.lever * normal.cross(Vec3(vertex(x, edge.other) - vertex(x, v)).normalized()));
  };
  if (vertices.size() == 2) {
    for (const RodEdge& edge : rods_[v])
      if (edge.other == vertices[1]) add_edge(edge, 1);
    return;
  }
  if (particle_[v][0] >= 0)
    for (int k = 0; k < 3; ++k) columns.add(particle_[v][k], lever_[v] * normal.cross(Vec3(Vec3::Unit(k))));
  if (rods_[v].size() <= 2)
    for (const RodEdge& edge : rods_[v]) add_edge(edge, 1.0 / static_cast<double>(rods_[v].size()));
}

}  // namespace tack
