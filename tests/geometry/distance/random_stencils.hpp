// Random and nearly degenerate four-vertex stencils, and numerical derivatives, for the distance
// tests.
#pragma once

#include <Eigen/Geometry>
#include <random>

#include "geometry/distance/stencil_derivatives.hpp"

namespace tack {

using Stencil = Eigen::Matrix<double, 3, 4>;  // one column a vertex

class RandomStencils {
 public:
  explicit RandomStencils(unsigned seed) : generator_(seed) {}

  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(generator_);
  }
  double log_uniform(double low, double high) {
    return std::exp(uniform(std::log(low), std::log(high)));
  }
  Vec3 vector() { return {uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)}; }
  Mat3 rotation() {
    return Eigen::Quaterniond(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1), uniform(0.1, 1))
        .normalized()
        .toRotationMatrix();
  }
  Stencil any() {
    Stencil x;
    for (int i = 0; i < 4; ++i) x.col(i) = vector();
    return x;
  }
  // A point above a triangle whose height over t0 t1 is `height`.
  Stencil above_triangle(double gap, double height) {
    Stencil x;
    x.col(1) = Vec3(0, 0, 0);
    x.col(2) = Vec3(1, 0, 0);
    x.col(3) = Vec3(uniform(0.2, 0.8), height, 0);
    const double a = uniform(0.1, 0.8), b = uniform(0.1, 0.9 - a);
    x.col(0) = (1 - a - b) * x.col(1) + a * x.col(2) + b * x.col(3) + Vec3(0, 0, gap);
    return placed(x);
  }
  // Two edges crossing at `angle`, at a distance of `gap`.
  Stencil crossing(double gap, double angle) {
    const Vec3 a(1, 0, 0), b(std::cos(angle), std::sin(angle), 0);
    const double u = uniform(0.2, 0.8), v = uniform(0.2, 0.8);
    Stencil x;
    x.col(0) = -u * a;
    x.col(1) = (1 - u) * a;
    x.col(2) = -v * b - Vec3(0, 0, gap);
    x.col(3) = (1 - v) * b - Vec3(0, 0, gap);
    return placed(x);
  }

 private:
  Stencil placed(const Stencil& x) { return (rotation() * x).colwise() + vector(); }

  std::mt19937 generator_;
};

// d f / d x by five-point central differences of step h; f(Stencil) is a scalar or a fixed-size
// vector.
template <int V, typename F>
auto numerical_jacobian(const F& f, const Stencil& x, double h) {
  using Row = Eigen::Matrix<double, 3 * V, 1>;
  Eigen::Matrix<double, 3 * V, 3 * V> jacobian;
  for (int k = 0; k < 3 * V; ++k) {
    const auto at = [&](double step) -> Row {
      Stencil moved = x;
      moved.data()[k] += step;
      return f(moved);
    };
    jacobian.col(k) = (8.0 * (at(h) - at(-h)) - (at(2 * h) - at(-2 * h))) / (12.0 * h);
  }
  return jacobian;
}

template <int V, typename F>
Eigen::Matrix<double, 3 * V, 1> numerical_gradient(const F& f, const Stencil& x, double h) {
  Eigen::Matrix<double, 3 * V, 1> gradient;
  for (int k = 0; k < 3 * V; ++k) {
    const auto at = [&](double step) {
      Stencil moved = x;
      moved.data()[k] += step;
      return f(moved);
    };
    gradient[k] = (8.0 * (at(h) - at(-h)) - (at(2 * h) - at(-2 * h))) / (12.0 * h);
  }
  return gradient;
}

}  // namespace tack
