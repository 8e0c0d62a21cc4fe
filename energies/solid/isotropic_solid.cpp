#include "energies/solid/isotropic_solid.hpp"

namespace tack {

void SolidEnergy::fields(Fields& f) {
  Energy::fields(f);
  f.number("young", young_, units::pressure, "Young's modulus").required().positive();
  f.number("poisson", poisson_, units::none, "Poisson's ratio").range(-0.99, 0.4999);
  f.number("density", density_, units::density, "mass per rest volume").positive();
}

void add_tet_mass(const Body& body, const VecX& rest, double density, VecX& mass) {
  const auto data = tet_rest_data(body, rest);
  for (size_t t = 0; t < data.size(); ++t)
    for (const int v : body.tets[t]) mass(v) += density * data[t].volume / 4;
}

}  // namespace tack
