// Pressure on the surface of an object, or in a fluid cavity; it follows the surface.
#include "energies/loads/pressure_term.hpp"
#include "framework/body/cavity_surface.hpp"
#include "framework/load/cavity_content.hpp"
#include "framework/world/load.hpp"

namespace tack {
namespace {

class Pressure : public Load {
 public:
  void fields(Fields& f) override {
    f.text("name", name_, "name in messages and probes; the object's unless given").line();
    f.number("value", value_, units::pressure,
             "positive pushes on faces of solids, inflates closed sheets, and pushes an open sheet along the normals of its triangles").required();
    ramp_.fields(f, "ramp", "factor over time");
    f.component("select", select_, "vertices; triangles with all three selected are loaded");
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

class PressureContent : public CavityContent {
 public:
  void fields(Fields& f) override {
    f.number("value", value_, units::pressure, "pressure; positive acts from inside").required();
    ramp_.fields(f, "ramp", "factor over time");
  }
  std::unique_ptr<VolumeTerm> make_term(std::string label, OrientedSurface surface, const VecX&) const override {
    return std::make_unique<PressureTerm>(std::move(label), std::move(surface), value_, ramp_);
  }

 private:
  double value_ = 0;  // Pa
  Ramp ramp_;
};

TACK_REGISTER(Load, Pressure, "pressure", "Follower pressure: along the current normals, on the current area of a surface.", "");
TACK_REGISTER(CavityContent, PressureContent, "pressure", "A prescribed pressure, independent of the volume.", "");

}  // namespace
}  // namespace tack
