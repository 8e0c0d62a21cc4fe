// What rods and particles have of their areas towards triangles (thin_view.hpp), from step to step. It is held in a step, and so what
// it changes by exerts no force: where a body is as soft as the traction that pulls on it, a vertex goes too far, has another share
// there, comes back too far, and so in every other step for ever, whatever their size. A point that is about to turn back goes only a part
// of the way: of r, by how much its shares and normals towards an object differ from those that were held in the step before, it takes t r,
//     t = t' r'.(r' - r) / |r' - r|^2,  in [0.1, 1],
// ' before: where r is linear in what is held, that finds what stays. While it goes on in one direction, t is 1, and nothing lags.
// Source: Irons and Tuck 1969, A version of the Aitken accelerator for computer iteration; Kuettler and Wall 2008, Fixed-point
// fluid-structure interaction solvers with dynamic relaxation.
#pragma once

#include <span>
#include <vector>

#include "framework/contact/thin_view.hpp"
#include "framework/core/history.hpp"
#include "geometry/mesh/collision_mesh.hpp"

namespace tack {

// Of a point and a triangle within the range of its law: its share, and the triangle's normal.
struct RememberedShare {
  using Values = std::array<double, 4>;
  int point, triangle;
  Values held, change;  // as the step had them; r
  double part;          // t
};

// By point, then triangle.
using ShareMemory = std::vector<RememberedShare>;

// The shares of a point towards triangles of one object, and their normals, as the step holds them; appends what is to be remembered.
// range: of the law [m]; what is farther is taken as it is.
void relax_shares(int point, std::span<const int> triangles, double range, const ShareMemory& before, std::vector<TriangleShare>& shares,
                  ShareMemory& now);

// Of what the history has. Throws InputError for triangles that there are none of.
ShareMemory shares_of(const History& history, const CollisionMesh& mesh);
// Nothing stands there if there is nothing to remember.
void remember_shares(const ShareMemory& shares, const CollisionMesh& mesh, History& history);

}  // namespace tack
