#include "energies/solid/tet_geometry.hpp"

#include <fmt/core.h>

#include <Eigen/LU>

#include "geometry/errors.hpp"

namespace tack {

std::vector<TetRest<double>> tet_rest_data(const Body& body, const VecX& rest) {
  if (body.tets.empty())
    throw InputError(fmt::format("object '{}': a solid energy needs tetrahedra, and its shape has "
                                 "none; have its surface filled (shape: {{type: processed, of: SHAPE, steps: [tetrahedralize]}}, or "
                                 "`tack mesh tetrahedralize`), or use a tet mesh or shape", body.name));
  std::vector<TetRest<double>> data;
  data.reserve(body.tets.size());
  for (const TetReference& r : body.references) data.push_back({r.shape, r.volume});
  if (!data.empty()) return data;
  for (size_t t = 0; t < body.tets.size(); ++t) {
    const Tet& tet = body.tets[t];
    const Mat3 edges = edges_of(tet, rest);
    const double volume = edges.determinant() / 6;
    if (!(volume > 0))
      throw InputError(fmt::format("object '{}': tet {} has volume {} m^3 at rest; repair the mesh "
                                   "or reorder its vertices", body.name, t, volume));
    data.push_back({edges.inverse(), volume});
  }
  return data;
}

}  // namespace tack
