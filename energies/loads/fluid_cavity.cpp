// Fluid cavity inside one object.
#include <fmt/format.h>

#include "framework/body/cavity_surface.hpp"
#include "framework/load/cavity_content.hpp"
#include "framework/world/load.hpp"

namespace tack {
namespace {

class FluidCavityLoad : public Load {
 public:
  void fields(Fields& f) override {
    f.text("name", name_, "name in messages and probes; the object's unless given").line();
    f.component("content", content_, "content of the cavity").required();
    f.component("select", select_, "vertices; triangles with all three selected are its walls: a closed sheet, or the faces of a cavity");
  }
  std::unique_ptr<FollowingLoad> make_term(const Body& body, const VecX& rest, const VecX&) const override {
    const std::string label = name_.empty() ? body.name : name_;
    CavitySurface surface = cavity_surface({cavity_wall(*select_, {body, rest})}, rest, fmt::format("the chamber '{}'", label));
    return content_->make_term(label, OrientedSurface(std::move(surface.triangles)), rest);
  }

 private:
  std::string name_;
  std::unique_ptr<CavityContent> content_;
  std::unique_ptr<Selection> select_ = Registry<Selection>::make("all");
};

TACK_REGISTER(Load, FluidCavityLoad, "chamber", "Fluid cavity inside a closed sheet or a solid; its pressure depends on the enclosed volume.", "");

}  // namespace
}  // namespace tack
