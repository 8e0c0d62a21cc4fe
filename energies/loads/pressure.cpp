// A pressure on the surface of an object that follows it, and the same of a chamber.
#include "energies/loads/pressure_term.hpp"
#include "framework/body/chamber_surface.hpp"
#include "framework/load/filling.hpp"
#include "framework/world/load.hpp"

namespace tack {
namespace {

class Pressure : public Load {
 public:
  void fields(Fields& f) override {
    f.text("name", name_, "in messages and probes; the object's unless given").line();
    f.number("value", value_, units::pressure,
             "above zero, it presses on faces of solids, inflates what is closed, and pushes an open sheet along the normals of its triangles").required();
    ramp_.fields(f, "ramp", "factor over time");
    f.component("select", select_, "vertices; triangles with all three selected are pressed");
  }
  std::unique_ptr<FollowingLoad> make_term(const Body& body, const VecX& rest, const VecX&) const override {
    return std::make_unique<PressureTerm>(name_.empty() ? body.name : name_, OrientedSurface(pressed_triangles(*select_, {body, rest})), value_, ramp_);
  }

 private:
  std::string name_;
  double value_ = 0;  // Pa
  Ramp ramp_;
  std::unique_ptr<Selection> select_ = Registry<Selection>::make("all");
};

class PressureFilling : public Filling {
 public:
  void fields(Fields& f) override {
    f.number("value", value_, units::pressure, "above zero, from within").required();
    ramp_.fields(f, "ramp", "factor over time");
  }
  std::unique_ptr<VolumeTerm> make_term(std::string label, OrientedSurface surface, const VecX&) const override {
    return std::make_unique<PressureTerm>(std::move(label), std::move(surface), value_, ramp_);
  }

 private:
  double value_ = 0;  // Pa
  Ramp ramp_;
};

TACK_REGISTER(Load, Pressure, "pressure", "A pressure that follows a surface: along its present normals, on its present area.", "");
TACK_REGISTER(Filling, PressureFilling, "pressure", "A pressure that is given, whatever the volume.", "");

}  // namespace
}  // namespace tack
