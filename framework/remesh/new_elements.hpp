// Better tets for an object at its current positions.
#pragma once

#include <array>
#include <utility>

#include "framework/body/flowed_mesh.hpp"
#include "framework/core/records.hpp"

namespace tack {

// Where a vertex was in the mesh before: between its vertices, numbered in the object.
struct Within {
  Tet vertices;
  std::array<double, 4> weights;  // that add up to one
};

struct NewElements {
  int body = -1;
  FlowedMesh mesh;
  std::vector<Vec3> places;    // of its vertices now [m]
  std::vector<int> from;       // of each vertex: its number before; -1: it is new, or has moved
  std::vector<Within> within;  // of each that is: where
  std::vector<double> flow;    // of each tet: the accumulated plastic strain
  double before = 0, after = 0;  // lowest mean ratios
};

// At x (3n), where the step ended that was kept last. goal: the mean ratio that is good enough.
NewElements new_elements(int index, const Body& body, const ExchangeableTets& old, const VecX& rest,
                         const VecX& x, double goal);

}  // namespace tack
