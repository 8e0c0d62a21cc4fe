// Probes of forces and errors of joints.
#include <fmt/format.h>

#include <Eigen/QR>
#include <Eigen/SparseCore>
#include <map>

#include "framework/config/nearest.hpp"
#include "framework/core/term_gradient.hpp"
#include "framework/output/probe.hpp"
#include "framework/probes/interaction_probe.hpp"
#include "framework/probes/unbalanced.hpp"
#include "framework/world/world.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

const Joint& joint_named(const World& world, const std::string& name, const std::string& probe, std::string_view type) {
  for (const Joint& joint : world.constraints.joints())
    if (joint.name == name) return joint;
  refuse_interaction_type(interaction_named(world, name, probe), probe, type);
}

// Returns the dof map without joints.
DofMap dofs_without_joints(const World& world, const State& state) {
  const auto assignments = static_cast<std::ptrdiff_t>(world.prescribed_motion.assignments().size());
  std::vector<char> active = state.motion_active;
  if (active.empty()) {
    active = world.prescribed_motion.active(state.time);
    const std::vector<char> constraints = world.constraints.active(state.time);
    active.insert(active.end(), constraints.begin(), constraints.end());
  }
  const std::vector<char> free = world.prescribed_motion.free(active);
  return DofMap(free, world.constraints.unjoined_at(free, {active.begin() + assignments, active.end()}), world.prescribed_motion.fixed_directions(active));
}

// Returns one multiplier L [N] per relation of each joint, in their order: for a relation sum_i w_i
// x_i = 0, the sum of w_i L and of the unbalanced force is zero at each vertex that is not
// otherwise determined. Redundant relations get the multipliers of minimum norm.
Eigen::MatrixXd multipliers(const World& world, const State& state) {
  const DofMap dofs = dofs_without_joints(world, state);
  VecX unbalanced = unbalanced_forces(world, state);
  dofs.move_to_independents(unbalanced);
  std::vector<Eigen::Triplet<double>> entries;  // block, relation, weight
  int relations = 0;
  for (const Joint& joint : world.constraints.joints())
    for (const Joint::Relation& relation : joint.relations) {
      for (const auto& [v, weight] : relation) {
        if (dofs.mixed(v))
          for (const DofMap::WeightedIndex& entry : dofs.blocks(v)) entries.emplace_back(entry.index, relations, weight * entry.weight);
        else if (dofs.block(v) >= 0)
          entries.emplace_back(dofs.block(v), relations, weight);
      }
      ++relations;
    }
  std::map<int, int> row;  // row of each block
  for (const auto& entry : entries) row.try_emplace(entry.row());
  // Prescribed motions carry the load of blocks that they fix in part.
  for (const DofMap::PartlyFixedBlock& fixed : dofs.partly_fixed_blocks()) row.erase(fixed.block);
  int rows = 0;
  for (auto& [block, number] : row) number = rows++;
  Eigen::MatrixXd weights = Eigen::MatrixXd::Zero(rows, relations), forces(rows, 3);
  for (const auto& entry : entries)
    if (const auto at = row.find(entry.row()); at != row.end()) weights(at->second, entry.col()) += entry.value();
  for (const auto& [block, number] : row) forces.row(number) = -vertex(unbalanced, dofs.vertex_of_block(block)).transpose();
  return weights.completeOrthogonalDecomposition().solve(forces);
}

// Returns the forces of a joint on vertices (3n) [N], by its relations and its terms.
VecX forces_of_joint(const Joint& joint, const World& world, const State& state) {
  VecX forces = VecX::Zero(state.x.size());
  for (const ActingInteraction& interaction : world.interactions)
    if (interaction.name == joint.name)
      for (const Term* term : interaction.terms) add_term_gradient(*term, state.x, forces);
  forces = -forces;
  const Eigen::MatrixXd all = multipliers(world, state);
  Eigen::Index relation = 0;
  for (const Joint& other : world.constraints.joints())
    for (const Joint::Relation& r : other.relations) {
      if (&other == &joint)
        for (const auto& [v, weight] : r) vertex(forces, v) -= weight * all.row(relation).transpose();
      ++relation;
    }
  return forces;
}

template <class Base>
class JointProbe : public Base {
 public:
  void fields(Fields& f) override {
    Base::fields(f);
    f.text("interaction", interaction_, "the joint").required();
  }
  void prepare(const World& world) override { joint_ = &joint_named(world, interaction_, this->name_, this->type()); }

 protected:
  const Joint& joint() const { return *joint_; }

 private:
  std::string interaction_;
  const Joint* joint_ = nullptr;
};

class JointForce : public JointProbe<VectorProbe> {
 public:
  Unit unit() const override { return units::force; }

 protected:
  Vec3 value(const World& world, const State& state) override {
    const VecX forces = forces_of_joint(joint(), world, state);
    Vec3 sum = Vec3::Zero();
    for (const int v : joint().attachment_points) sum += vertex(forces, v);
    return sum;
  }
};

class JointTorque : public JointProbe<VectorProbe> {
 public:
  Unit unit() const override { return units::moment; }

 protected:
  Vec3 value(const World& world, const State& state) override {
    const VecX forces = forces_of_joint(joint(), world, state);
    const Vec3 about = vertex(state.x, joint().attachment_points.front());
    Vec3 sum = Vec3::Zero();
    for (const int v : joint().attachment_points) sum += (vertex(state.x, v) - about).cross(Vec3(vertex(forces, v)));
    return sum;
  }
};

class JointError : public JointProbe<Probe> {
 public:
  Unit unit() const override { return units::length; }
  std::vector<double> sample(const World&, const State& state) override { return {joint_error(joint(), state.x)}; }
};

TACK_REGISTER(Probe, JointForce, "joint_force", "Total force of a joint on its object [N].", "");
TACK_REGISTER(Probe, JointTorque, "joint_torque", "Moment of a joint on its object about the joint point, including limits, friction and motors [N "
                                                  "m].", "");
TACK_REGISTER(Probe, JointError, "joint_error", "Largest distance between points that a joint constrains to coincide [m].", "");

}  // namespace
}  // namespace tack
