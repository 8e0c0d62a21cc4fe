// A rectangle of triangles as a body, and its deformations.
#pragma once

#include <functional>

#include "framework/body/body.hpp"
#include "geometry/shapes/surfaces.hpp"

namespace tack {

struct SheetBody {
  SheetBody(const Vec2& size, const std::array<int, 2>& cells, double thickness, double jitter = 0,
            Diagonals diagonals = Diagonals::uniform);

  // x = map(X); the rectangle lies in the plane y = 0.
  VecX mapped(const std::function<Vec3(const Vec3&)>& map) const;

  Body body;
  VecX rest;
  double volume;
};

}  // namespace tack
