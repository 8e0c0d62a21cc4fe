// Probes of positions and velocities.
#include <algorithm>
#include <tuple>

#include "framework/contact/contact_system.hpp"
#include "framework/output/probe.hpp"
#include "framework/probes/vertex_set.hpp"
#include "framework/world/world.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

class CentreOfMass : public VectorProbe {
 public:
  void fields(Fields& f) override {
    VectorProbe::fields(f);
    f.text("object", object_, "name of the object").required();
    f.flag("velocity", velocity_, "record the velocity [m/s] instead of the position [m]");
  }
  Unit unit() const override { return velocity_ ? units::velocity : units::length; }
  void prepare(const World& world) override { index_ = object_index(world, object_, name_); }

 protected:
  Vec3 value(const World& world, const State& state) override {
    return world.centre_of_mass(index_, velocity_ ? state.v : state.x);
  }

 private:
  std::string object_;
  bool velocity_ = false;
  int index_ = -1;
};

// Distance of the mean positions of two sets of vertices along a direction.
class Separation : public Probe {
 public:
  void fields(Fields& f) override {
    Probe::fields(f);
    f.object("from", from_, "vertices at which it starts");
    f.object("to", to_, "vertices at which it ends");
    f.vector("direction", direction_, units::none, "direction of the distance");
    f.flag("relative", relative_, "relative to the value at rest: (d - d0) / d0, a nominal strain");
    f.check("direction", [this]() -> std::string { return direction_.norm() > 0 ? "" : "must not be zero"; });
  }
  void prepare(const World& world) override {
    from_.prepare(world, name_);
    to_.prepare(world, name_);
    at_rest_ = distance(world.rest);
    if (relative_ && at_rest_ == 0)
      throw InputError("probe '" + name_ + "': relative, but the separation at rest is zero");
  }
  Unit unit() const override { return relative_ ? units::none : units::length; }
  std::vector<double> sample(const World&, const State& state) override {
    const double d = distance(state.x);
    return {relative_ ? (d - at_rest_) / at_rest_ : d};
  }

 private:
  double distance(const VecX& x) const {
    return (to_.mean(x) - from_.mean(x)).dot(direction_.normalized());
  }
  VertexSet from_, to_;
  Vec3 direction_ = Vec3::UnitY();
  bool relative_ = false;
  double at_rest_ = 0;
};

// Smallest distance between two objects; infinity beyond the contact range.
class Gap : public Probe {
 public:
  void fields(Fields& f) override {
    Probe::fields(f);
    between_.fields(f);
  }
  void prepare(const World& world) override {
    require_contact(world, name_);
    std::tie(a_, b_) = between_.prepare(world, name_);
  }
  Unit unit() const override { return units::length; }
  bool unbounded() const override { return true; }
  std::vector<double> sample(const World& world, const State& state) override {
    const CollisionMesh& mesh = world.contact->surface().mesh;
    return {smallest_gaps(world.contact->surface(), world.contact->pairs(), candidates_between(mesh, world.contact->candidates(), a_, b_), state.x).of_all};
  }

 private:
  ObjectNames between_;
  int a_ = -1, b_ = -1;
};

// Number of objects whose centre of mass is in a box.
class ObjectsWithin : public Probe {
 public:
  void fields(Fields& f) override {
    Probe::fields(f);
    f.text("of", of_, "an object; with `fill`, all of its copies").required();
    f.vector("min", min_, units::length, "lowest corner of the box").required();
    f.vector("max", max_, units::length, "highest corner").required();
    f.check("max", [this]() -> std::string { return (max_.array() > min_.array()).all() ? "" : "must be beyond min, in x, y and z"; });
  }
  void prepare(const World& world) override { objects_ = copies_of(world, of_, name_); }
  Unit unit() const override { return units::none; }
  std::vector<double> sample(const World& world, const State& state) override {
    return {static_cast<double>(std::count_if(objects_.begin(), objects_.end(), [&](int i) {
      const Vec3 c = world.centre_of_mass(i, state.x);
      return (c.array() >= min_.array()).all() && (c.array() <= max_.array()).all();
    }))};
  }

 private:
  std::string of_;
  Vec3 min_ = Vec3::Zero(), max_ = Vec3::Zero();
  std::vector<int> objects_;
};

TACK_REGISTER(Probe, CentreOfMass, "centre_of_mass", "Position or velocity of an object's centre of mass.", "");
TACK_REGISTER(Probe, ObjectsWithin, "objects_within", "Number of copies of an object whose centre of mass is in a box.", "");
TACK_REGISTER(Probe, Separation, "separation",
              "Distance between two sets of vertices along a direction [m], or its relative change.", "");
TACK_REGISTER(Probe, Gap, "gap", "Smallest distance between two objects [m].", "");

}  // namespace
}  // namespace tack
