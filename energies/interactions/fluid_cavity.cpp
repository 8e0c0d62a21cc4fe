// Fluid cavity between objects. Surfaces of the objects and virtual triangles over the slits between them enclose it; its pressure acts on all of
// them.
#include <fmt/format.h>

#include <algorithm>

#include "framework/body/cavity_surface.hpp"
#include "framework/load/fluid_cavity_term.hpp"
#include "framework/scene/interaction.hpp"
#include "framework/setup/interaction_builder.hpp"
#include "geometry/errors.hpp"
#include "geometry/mesh/quality.hpp"

namespace tack {
namespace {

class FluidCavityInteraction : public Interaction {
 public:
  void fields(Fields& f) override {
    Interaction::fields(f);
    f.list("parts", walls_, "walls of the cavity: the triangles of each object with all three vertices selected; slits between walls are closed by "
                            "virtual triangles that carry the same pressure")
        .required().nonempty();
    f.component("content", content_, "content of the cavity").required();
    f.number("vent", leak_speed_, units::velocity,
             "leak through slits between walls that open beyond twice their rest width: the pressure above ambient "
             "decays at the rate vent times the area beyond that width over the volume").nonnegative();
    f.check("vent", [this]() -> std::string {
      return leak_speed_ == 0 || dynamic_cast<const StoredContent*>(content_.get()) ? "" : "a prescribed pressure does not fall; fill the cavity with a gas or a liquid, or remove `vent`";
    });
  }
  std::vector<std::string> objects() const override {
    std::vector<std::string> names;
    for (const ObjectVertices& wall : walls_) names.push_back(wall.object);
    return names;
  }

  void build(InteractionBuilder& builder) const override {
    std::vector<CavityWall> walls;
    for (const ObjectVertices& wall : walls_) walls.push_back(cavity_wall(*wall.select, builder.world().selection_context(builder.body(wall.object))));
    const std::string who = fmt::format("interaction '{}'", builder.name());
    CavitySurface surface = cavity_surface(walls, builder.rest(), who);
    std::unique_ptr<VolumeTerm> term = content_->make_term(builder.name(), OrientedSurface(std::move(surface.triangles)), builder.rest());
    if (leak_speed_ > 0) {
      if (surface.slits.empty()) throw InputError(who + ": has a vent, but no slits between its parts; remove the vent, or give the gas a leak");
      auto& cavity = dynamic_cast<FluidCavityTerm&>(*term);
      std::vector<double> closed_area;
      for (const Triangle& t : surface.slits) closed_area.push_back(2 * triangle_area(builder.rest(), t));
      cavity.set_leak([slits = std::move(surface.slits), closed_area = std::move(closed_area), speed = leak_speed_, &cavity](const VecX& x) {
        double open = 0;
        for (size_t i = 0; i < slits.size(); ++i) open += std::max(0.0, triangle_area(x, slits[i]) - closed_area[i]);
        return speed * open / cavity.volume(x);
      });
    }
    if (term->stores()) builder.add_history("chamber", 2, 1);
    builder.add(std::move(term));
  }

 private:
  std::vector<ObjectVertices> walls_;
  std::unique_ptr<CavityContent> content_;
  double leak_speed_ = 0;  // m/s
};

TACK_REGISTER(Interaction, FluidCavityInteraction, "chamber", "Fluid cavity between surfaces of one or more objects; its pressure depends on the enclosed "
                                                      "volume.", "");

}  // namespace
}  // namespace tack
