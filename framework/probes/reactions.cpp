// Probes of reactions of prescribed vertices.
#include <algorithm>

#include "framework/output/probe.hpp"
#include "framework/probes/unbalanced.hpp"
#include "framework/probes/vertex_set.hpp"
#include "framework/rod/rod_frames.hpp"
#include "framework/world/world.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

// Returns the reaction force on each prescribed vertex (3n) [N], which balances its inertia and all
// other forces, in its prescribed directions; zero for free vertices.
VecX reaction_forces(const World& world, const State& state) {
  VecX gradient = unbalanced_forces(world, state), reactions = VecX::Zero(state.x.size());
  world.dofs.move_to_independents(gradient);
  for (int v = 0; v < world.dofs.vertex_count(); ++v)
    if (!world.dofs.moves(v)) vertex(reactions, v) = vertex(gradient, v);
  for (const DofMap::PartlyFixedBlock& h : world.dofs.partly_fixed_blocks())
    if (const int v = world.dofs.vertex_of_block(h.block); !h.scalar) vertex(reactions, v) = h.projection * vertex(gradient, v);
  return reactions;
}

// Throws InputError if some vertices have no prescribed motion at any time.
void require_fixed(const World& world, const VertexSet& set, const std::string& probe) {
  for (const int v : set.vertices())
    if (!world.prescribed_motion.ever_fixed(v))
      throw InputError("probe '" + probe + "': a reaction needs vertices with prescribed motion, and some of these are "
                       "free; give the selection of that motion");
}

// Sum of reaction forces; vertices that are free at present count zero.
class Reaction : public VectorProbe {
 public:
  void fields(Fields& f) override {
    VectorProbe::fields(f);
    set_.fields(f);
  }
  Unit unit() const override { return units::force; }
  void prepare(const World& world) override {
    set_.prepare(world, name_);
    require_fixed(world, set_, name_);
  }

 protected:
  Vec3 value(const World& world, const State& state) override {
    const VecX forces = reaction_forces(world, state);
    Vec3 sum = Vec3::Zero();
    for (const int v : set_.vertices()) sum += vertex(forces, v);
    return sum;
  }

 private:
  VertexSet set_;
};

// Moment of reactions about a point, including that of prescribed twists of rods: for an edge with
// both ends among the vertices, r f along its tangent, with the force f on the arc r theta.
class TorqueProbe : public VectorProbe {
 public:
  void fields(Fields& f) override {
    VectorProbe::fields(f);
    set_.fields(f);
    f.vector("centre", centre_, units::length, "a point of the axis");
  }
  Unit unit() const override { return units::moment; }
  void prepare(const World& world) override {
    set_.prepare(world, name_);
    require_fixed(world, set_, name_);
    const Body& body = world.bodies[world.body_of(set_.vertices().front())];
    if (!body.rod) return;
    rod_ = body.rod;
    const auto among = [&](int v) { return std::binary_search(set_.vertices().begin(), set_.vertices().end(), v); };
    for (int e = 0; e < rod_->count(); ++e)
      if (among(rod_->edge(e)[0]) && among(rod_->edge(e)[1])) edges_.push_back(e);
  }

 protected:
  Vec3 value(const World& world, const State& state) override {
    const VecX forces = reaction_forces(world, state);
    Vec3 sum = Vec3::Zero();
    for (const int v : set_.vertices()) sum += (vertex(state.x, v) - centre_).cross(Vec3(vertex(forces, v)));
    for (const int e : edges_) sum += rod_->radius() * forces(3 * rod_->twists()[e]) * rod_->tangent(e, state.x);
    return sum;
  }

 private:
  VertexSet set_;
  Vec3 centre_ = Vec3::Zero();  // m
  std::shared_ptr<const RodFrames> rod_;
  std::vector<int> edges_;  // of that rod
};

TACK_REGISTER(Probe, TorqueProbe, "torque", "Reaction moment on vertices with prescribed motion and on the twist of edges between them [N m].", "");
TACK_REGISTER(Probe, Reaction, "reaction", "Reaction force on vertices with prescribed motion [N].", "");

}  // namespace
}  // namespace tack
