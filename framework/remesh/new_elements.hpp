// Better tets for an object at its current positions.
#pragma once

#include <array>
#include <utility>

#include "framework/body/flowed_mesh.hpp"
#include "framework/core/records.hpp"

namespace tack {

// A point in a tet of the old mesh.
struct TetPoint {
  Tet vertices;                   // indices in the object
  std::array<double, 4> weights;  // barycentric coordinates; their sum is one
};

struct NewElements {
  int body = -1;
  FlowedMesh mesh;
  std::vector<Vec3> positions;   // current positions of its vertices [m]
  std::vector<int> from;         // per vertex: old index; -1: new or moved
  std::vector<TetPoint> within;  // per new or moved vertex: its point in the old mesh
  std::vector<double> flow;      // per tet: accumulated plastic strain
  double before = 0, after = 0;  // lowest mean ratios
};

// Returns new elements at the accepted positions x (3n) [m]. goal: target mean ratio.
NewElements new_elements(int index, const Body& body, const ExchangeableTets& old, const VecX& rest,
                         const VecX& x, double goal);

}  // namespace tack
