#include "geometry/shapes/prism.hpp"

#include <utility>

namespace tack {
namespace {

void add_tet(Mesh& mesh, Tet t) {
  for (int k = 0; k < 4; ++k)
    for (int m = 0; m < k; ++m)
      if (t[k] == t[m]) return;
  const auto& x = mesh.vertices;
  if ((x[t[1]] - x[t[0]]).cross(x[t[2]] - x[t[0]]).dot(x[t[3]] - x[t[0]]) < 0) std::swap(t[2], t[3]);
  mesh.tets.push_back(t);
}

}  // namespace

void add_prism(Mesh& mesh, const std::array<int, 3>& l, const std::array<int, 3>& r) {
  add_tet(mesh, {l[0], l[1], l[2], r[2]});
  add_tet(mesh, {l[0], l[1], r[1], r[2]});
  add_tet(mesh, {l[0], r[0], r[1], r[2]});
}

}  // namespace tack
