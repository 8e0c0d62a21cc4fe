#include "energies/solid/isotropic_solid.hpp"

namespace tack {

void add_tet_mass(const Body& body, const VecX& rest, double density, VecX& mass) {
  const auto data = tet_rest_data(body, rest);
  for (size_t t = 0; t < data.size(); ++t)
    for (const int v : body.tets[t]) mass(v) += density * data[t].volume / 4;
}

}  // namespace tack
