#include "energies/shell/membrane.hpp"

#include <fmt/format.h>

#include "geometry/errors.hpp"

namespace tack {

void FibreConfig::fields(Fields& f) {
  f.vector("direction", direction, units::none, "direction of the fibres, projected onto each rest triangle").required();
  f.number("young", young, units::pressure, "E_f: added to Young's modulus along the fibres").required().positive();
  f.check("direction", [this]() -> std::string { return direction.norm() > 0 ? "" : "must not be zero"; });
}

void MembraneEnergy::fields(Fields& f) {
  Energy::fields(f);
  f.number("young", young_, units::pressure, "Young's modulus").required().positive();
  f.number("poisson", poisson_, units::none, "Poisson's ratio").range(0, 0.4999);
  f.number("density", density_, units::density, "mass per rest volume").positive();
  f.optional_object("fibre", fibre_, "fibres that stiffen one direction: they add E_f/2 ((|F d|^2 - 1)/2)^2 to the density");
}

Fibres MembraneEnergy::fibres(const Body& body, const VecX& rest) const {
  require_sheet(body, rest, type());
  if (!fibre_) return {};
  Fibres out{fibre_->young, std::vector<PackVec2>((body.sheet.size() + pack_width - 1) / pack_width)};
  const Vec3 direction = fibre_->direction.normalized();
  for (size_t t = 0; t < out.directions.size() * pack_width; ++t) {
    const size_t triangle = std::min(t, body.sheet.size() - 1);
    const Vec2 flat = sheet_frame(body.sheet[triangle], rest).transpose() * direction;
    if (!(flat.norm() > 1e-6))
      throw InputError(fmt::format("object '{}': the fibres of {} are across its triangle {}; give them a direction in the sheet, "
                                   "or select the part that they are in", body.name, type(), triangle));
    set_lane<2, 1>(out.directions[t / pack_width], static_cast<int>(t % pack_width), Vec2(flat.normalized()));
  }
  return out;
}

}  // namespace tack
