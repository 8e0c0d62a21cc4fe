// Probes of forces on objects and between two objects, over all published forces
// (core/records.hpp).
#include <fmt/format.h>

#include <algorithm>

#include "framework/config/nearest.hpp"
#include "framework/output/probe.hpp"
#include "framework/probes/vertex_set.hpp"
#include "framework/world/world.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

// Force of one object on another, or of all objects on one.
class PairForce : public VectorProbe {
 public:
  void fields(Fields& f) override {
    VectorProbe::fields(f);
    f.text("on", on_, "the object that the force acts on").required();
    f.text("from", from_, "the object that exerts it; without it, all others together");
  }
  Unit unit() const override { return units::force; }
  void prepare(const World& world) override {
    a_ = object_index(world, on_, name_);
    b_ = from_.empty() ? -1 : object_index(world, from_, name_);
  }

 protected:
  bool from_one() const { return !from_.empty(); }
  Vec3 force(const ForceRecord& record, std::string_view summand, const World& world, const VecX& x) const {
    if (b_ >= 0) return record.between ? record.between(x, summand, {a_, b_}) : Vec3(Vec3::Zero());
    VecX forces = VecX::Zero(x.size());
    record.add(x, summand, forces);
    Vec3 sum = Vec3::Zero();
    for (const int v : world.vertices_of(a_))
      if (!world.is_scalar_dof(v)) sum += vertex(forces, v);
    return sum;
  }
  // Returns the sum of all forces that act in that direction.
  Vec3 force(ForceDirection direction, std::string_view summand, const World& world, const VecX& x) const {
    Vec3 sum = Vec3::Zero();
    for (const ForceRecord& record : world.records.forces())
      if (record.direction == direction && record.has(summand)) sum += force(record, summand, world, x);
    return sum;
  }

 private:
  std::string on_, from_;
  int a_ = -1, b_ = -1;
};

// Contact force of the second object on the first, or of all objects on one.
class ContactForce : public PairForce {
 public:
  void fields(Fields& f) override {
    PairForce::fields(f);
    f.choice("part", part_,
             {{"all", LawChoice::all, "barrier and adhesion"},
              {"barrier", LawChoice::barrier, "repulsion only"},
              {"adhesion", LawChoice::adhesion, "attraction only"}},
             "normal laws that count");
  }

  void prepare(const World& world) override {
    if (!world.records.has_forces(ForceDirection::normal)) require_contact(world, name_);
    PairForce::prepare(world);
  }

 protected:
  Vec3 value(const World& world, const State& state) override {
    return force(ForceDirection::normal, part_ == LawChoice::all ? "" : part_ == LawChoice::barrier ? "barrier" : "adhesion", world, state.x);
  }

 private:
  enum class LawChoice { all, barrier, adhesion };
  LawChoice part_ = LawChoice::all;
};

// Tangential force of the second object on the first, or of all on one, in the last step.
class FrictionForce : public PairForce {
 public:
  void fields(Fields& f) override {
    PairForce::fields(f);
    f.choice("part", part_,
             {{"all", LawChoice::all, "friction and tangential adhesion"},
              {"friction", LawChoice::friction, "friction only"},
              {"adhesion", LawChoice::adhesion, "tangential adhesion only"}},
             "tangential laws that count");
  }

  void prepare(const World& world) override {
    if (!world.records.has_forces(ForceDirection::tangential))
      throw InputError("probe '" + name_ + "': no pair has friction or tangential adhesion; give one "
                       "in contact.pairs");
    PairForce::prepare(world);
  }

 protected:
  Vec3 value(const World& world, const State& state) override {
    return force(ForceDirection::tangential, part_ == LawChoice::all ? "" : part_ == LawChoice::friction ? "friction" : "adhesion", world, state.x);
  }

 private:
  enum class LawChoice { all, friction, adhesion };
  LawChoice part_ = LawChoice::all;
};

// Force of a given name.
class NamedForce : public PairForce {
 public:
  void fields(Fields& f) override {
    PairForce::fields(f);
    f.text("of", of_, "published name: contact, rim (overlap-boundary force), bonds, friction, damping, or one of a plugin").required();
    f.text("part", part_, "published component of it; all unless given");
  }

  void prepare(const World& world) override {
    PairForce::prepare(world);
    std::vector<std::string> names;
    for (const ForceRecord& record : world.records.forces()) {
      if (std::find(names.begin(), names.end(), record.name) == names.end()) names.push_back(record.name);
      if (record.name != of_) continue;
      if (!record.has(part_))
        throw InputError(fmt::format("probe '{}': the force '{}' has no part '{}'{}", name_, of_, part_, suggestion(part_, record.summands, "parts")));
      if (from_one() && !record.between)
        throw InputError(fmt::format("probe '{}': the force '{}' is not exerted by objects; take `from` away", name_, of_));
    }
    if (std::find(names.begin(), names.end(), of_) == names.end())
      throw InputError(fmt::format("probe '{}': no force is named '{}' in this scene{}", name_, of_, suggestion(of_, names, "forces")));
  }

 protected:
  Vec3 value(const World& world, const State& state) override {
    Vec3 sum = Vec3::Zero();
    for (const ForceRecord& record : world.records.forces())
      if (record.name == of_ && record.has(part_)) sum += force(record, part_, world, state.x);
    return sum;
  }

 private:
  std::string of_, part_;
};

TACK_REGISTER(Probe, ContactForce, "contact_force", "Normal contact force between objects [N].", "");
TACK_REGISTER(Probe, FrictionForce, "friction_force", "Friction and tangential adhesion between objects in the last step [N].", "");
TACK_REGISTER(Probe, NamedForce, "force", "A force that the scene publishes, on an object [N].", "");

}  // namespace
}  // namespace tack
