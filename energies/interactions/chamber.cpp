// A chamber between objects: surfaces that together enclose it, with the slits between them closed. What fills it presses on all of them.
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

class ChamberBetween : public Interaction {
 public:
  void fields(Fields& f) override {
    Interaction::fields(f);
    f.list("parts", parts_, "walls of the cavity: the triangles of each object with all three vertices selected; slits between walls are closed by "
                            "virtual triangles that carry the same pressure")
        .required().nonempty();
    f.component("content", content_, "content of the cavity").required();
    f.number("vent", vent_, units::velocity,
             "leak through slits between walls that open beyond twice their rest width: the pressure above ambient "
             "decays at the rate vent times the area beyond that width over the volume").nonnegative();
    f.check("vent", [this]() -> std::string {
      return vent_ == 0 || dynamic_cast<const StoredContent*>(content_.get()) ? "" : "a pressure that is given does not fall; fill the chamber with a gas or a liquid, or take it away";
    });
  }
  std::vector<std::string> objects() const override {
    std::vector<std::string> names;
    for (const ObjectVertices& part : parts_) names.push_back(part.object);
    return names;
  }

  void build(InteractionBuilder& builder) const override {
    std::vector<CavityWall> parts;
    for (const ObjectVertices& part : parts_) parts.push_back(cavity_wall(*part.select, builder.world().selection_context(builder.body(part.object))));
    const std::string who = fmt::format("interaction '{}'", builder.name());
    CavitySurface around = cavity_surface(parts, builder.rest(), who);
    std::unique_ptr<VolumeTerm> term = content_->make_term(builder.name(), OrientedSurface(std::move(around.triangles)), builder.rest());
    if (vent_ > 0) {
      if (around.slits.empty()) throw InputError(who + ": has a vent, and no slits between its parts; take it away, or give the gas a leak");
      auto& chamber = dynamic_cast<FluidCavityTerm&>(*term);
      std::vector<double> shut;
      for (const Triangle& t : around.slits) shut.push_back(2 * triangle_area(builder.rest(), t));
      chamber.set_leak([slits = std::move(around.slits), shut = std::move(shut), speed = vent_, &chamber](const VecX& x) {
        double open = 0;
        for (size_t i = 0; i < slits.size(); ++i) open += std::max(0.0, triangle_area(x, slits[i]) - shut[i]);
        return speed * open / chamber.volume(x);
      });
    }
    if (term->stores()) builder.add_history("chamber", 2, 1);
    builder.add(std::move(term));
  }

 private:
  std::vector<ObjectVertices> parts_;
  std::unique_ptr<CavityContent> content_;
  double vent_ = 0;  // m/s
};

TACK_REGISTER(Interaction, ChamberBetween, "chamber", "Fluid cavity between surfaces of one or more objects; its pressure depends on the enclosed "
                                                      "volume.", "");

}  // namespace
}  // namespace tack
