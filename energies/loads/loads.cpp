// Loads: a traction on part of a surface, a force on vertices, and a force per mass on a body.
#include <Eigen/Geometry>
#include <memory>

#include "energies/loads/linear_profile.hpp"
#include "framework/body/chosen_vertices.hpp"
#include "framework/body/selection.hpp"
#include "framework/world/load.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

// Dead load: force per rest area on the surface triangles whose three vertices are selected, a third
// to each vertex with the profile taken there.
class Traction : public Load {
 public:
  void fields(Fields& f) override {
    f.vector("value", value_, units::pressure, "force per rest area").required();
    f.component("select", select_, "vertices; triangles with all three selected are loaded");
    profile_.fields(f);
  }

  void add_forces(const Body& body, const VecX& rest, const VecX&, double t,
                  VecX& force) const override {
    const ChosenVertices chosen(body, select(*select_, {body, rest}));
    bool any = false;
    for (const Triangle& tri : body.triangles) {
      if (!chosen.contains(tri)) continue;
      any = true;
      const Vec3 a = vertex(rest, tri[0]), b = vertex(rest, tri[1]), c = vertex(rest, tri[2]);
      const double third = (b - a).cross(c - a).norm() / 6;
      for (const int v : tri)
        vertex(force, v) += third * profile_.at(vertex(rest, v), t) * value_;
    }
    if (!any)
      throw InputError("object '" + body.name + "': its traction's selection holds no whole surface "
                       "triangle; widen it");
  }

  std::vector<double> corners() const override { return profile_.corners(); }
  std::string drive() const override { return profile_.drive; }

 private:
  Vec3 value_ = Vec3::Zero();  // Pa
  std::unique_ptr<Selection> select_ = Registry<Selection>::make("all");
  LoadProfile profile_;
};

class Force : public Load {
 public:
  void fields(Fields& f) override {
    f.vector("value", value_, units::force, "total force, shared equally by the vertices").required();
    f.component("select", select_, "vertices");
    profile_.fields(f);
  }
  void add_forces(const Body& body, const VecX& rest, const VecX&, double t, VecX& force) const override {
    const std::vector<int> chosen = select(*select_, {body, rest});
    for (const int v : chosen) vertex(force, v) += profile_.at(vertex(rest, v), t) * value_ / static_cast<double>(chosen.size());
  }

  std::vector<double> corners() const override { return profile_.corners(); }
  std::string drive() const override { return profile_.drive; }

 private:
  Vec3 value_ = Vec3::Zero();  // N
  std::unique_ptr<Selection> select_ = Registry<Selection>::make("all");
  LoadProfile profile_;
};

class BodyForce : public Load {
 public:
  void fields(Fields& f) override {
    f.vector("value", value_, units::acceleration, "force per mass").required();
    f.component("select", select_, "vertices");
    profile_.fields(f);
  }
  void add_forces(const Body& body, const VecX& rest, const VecX& mass, double t,
                  VecX& force) const override {
    const std::vector<int> chosen = select(*select_, {body, rest});
    if (!body.frame.empty() && static_cast<int>(chosen.size()) != body.vertex_count)
      throw InputError("object '" + body.name + "': a body force on part of an affine body has no meaning (its mass is that "
                       "of the whole); select all of it, or use a traction");
    for (const int v : body.frame.empty() ? chosen : body.frame)
      vertex(force, v) += mass(v) * profile_.at(vertex(rest, v), t) * value_;
  }

  std::vector<double> corners() const override { return profile_.corners(); }
  std::string drive() const override { return profile_.drive; }

 private:
  Vec3 value_ = Vec3::Zero();  // m/s^2
  std::unique_ptr<Selection> select_ = Registry<Selection>::make("all");
  LoadProfile profile_;
};

TACK_REGISTER(Load, Traction, "traction", "Force per rest area on a region of the surface.", "");
TACK_REGISTER(Load, Force, "force", "A force on vertices: on the tip of a rod, on particles.", "");
TACK_REGISTER(Load, BodyForce, "body_force", "Force per mass on a body.", "");

}  // namespace
}  // namespace tack
