// A box of tetrahedra as a body, and its deformations.
#pragma once

#include <Eigen/Geometry>
#include <random>

#include "framework/scene/body.hpp"
#include "geometry/mesh/surface.hpp"
#include "geometry/shapes/solids.hpp"

namespace tack {

struct TetBody {
  TetBody(const Vec3& size, const std::array<int, 3>& cells) : volume(size.prod()) {
    const Mesh mesh = box_tets(size, cells);
    body.name = "box";
    body.vertex_count = static_cast<int>(mesh.vertices.size());
    body.tets = mesh.tets;
    body.triangles = extract_surface(mesh).triangles;
    rest.resize(3 * body.vertex_count);
    for (int v = 0; v < body.vertex_count; ++v) vertex(rest, v) = mesh.vertices[v];
  }

  // x = F X
  VecX deformed(const Mat3& f) const {
    VecX x(rest.size());
    for (int v = 0; v < body.vertex_count; ++v) vertex(x, v) = f * vertex(rest, v);
    return x;
  }

  Body body;
  VecX rest;
  double volume;
};

class RandomMotions {
 public:
  explicit RandomMotions(unsigned seed) : generator_(seed) {}
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(generator_);
  }
  Vec3 vector() { return {uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)}; }
  VecX vectors(Eigen::Index size) {
    return VecX::NullaryExpr(size, [this] { return uniform(-1, 1); });
  }
  Mat3 rotation() {
    return Eigen::Quaterniond(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1), uniform(0.1, 1))
        .normalized()
        .toRotationMatrix();
  }

 private:
  std::mt19937 generator_;
};

}  // namespace tack
