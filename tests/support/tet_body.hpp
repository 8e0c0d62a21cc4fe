// A box of tetrahedra as a body, and its deformations.
#pragma once

#include <array>
#include <random>

#include "framework/body/body.hpp"

namespace tack {

struct TetBody {
  TetBody(const Vec3& size, const std::array<int, 3>& cells, Elements elements = Elements::linear);

  VecX deformed(const Mat3& f) const;  // x = F X

  Body body;
  VecX rest;
  double volume;
};

class RandomMotions {
 public:
  explicit RandomMotions(unsigned seed) : generator_(seed) {}
  double uniform(double low, double high);
  Vec3 vector();  // in [-1, 1]^3
  VecX vectors(Eigen::Index size);
  Mat3 rotation();

 private:
  std::mt19937 generator_;
};

}  // namespace tack
