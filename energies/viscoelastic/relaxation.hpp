// Decay of the elastic strain of a Maxwell branch (maxwell.hpp) over a step, for solids (N = 3) and
// sheets (N = 2). The spring stores mu |e|^2 + lambda/2 (tr e)^2 in its Hencky strain e.
#pragma once

#include <cmath>

#include "geometry/types.hpp"

namespace tack {

template <int N>
struct Relaxation {
  using Matrix = Eigen::Matrix<double, N, N>;
  using Vector = Eigen::Matrix<double, N, 1>;

  double mu, lambda;  // Pa
  double time;        // relaxation time [s]
  bool isochoric;     // only the deviator decays

  // Factors b and a of a step h [s]: what is left of the strain after the decays at its start and
  // end.
  double start(double h) const { return std::exp(-h / time) / end(h); }
  double end(double h) const { return h > 0 ? -std::expm1(-h / time) * time / h : 1; }

  // The part of a Hencky strain that decays, in principal axes. axes: right singular vectors of an
  // elastic deformation gradient; stretches: its singular values.
  struct Strain {
    Matrix tensor() const { return axes * values.asDiagonal() * axes.transpose(); }
    Matrix axes;
    Vector values;
  };
  Strain strain(const Matrix& axes, const Vector& stretches) const {
    Strain e{axes, stretches.array().log()};
    if (isochoric) e.values.array() -= e.values.sum() / N;
    return e;
  }

  // Returns what F_v^-1 is multiplied by when a fraction of the strain is left.
  Matrix flow(const Strain& e, double left) const {
    const Vector factors = ((left - 1) * e.values).array().exp();
    const Matrix f = e.axes * factors.asDiagonal() * e.axes.transpose();
    return isochoric ? Matrix(f / std::pow(f.determinant(), 1.0 / N)) : f;
  }

  // Returns the dissipation of a step h [s] from the strain `first` to the trial strain `trial` at
  // a constant rate [J/m^3]: the integral of 2 psi(e) / time, e = steady + (first - steady)
  // exp(-t / time).
  double dissipated(double h, const Matrix& first, const Matrix& trial) const {
    const double x = h / time;
    const Matrix steady = (trial - start(h) * first) / x, rest = first - steady;
    const double once = -std::expm1(-x), twice = -std::expm1(-2 * x) / 2;
    return 2 * (x * product(steady, steady) + 2 * once * product(steady, rest) +
                twice * product(rest, rest));
  }

 private:
  // The bilinear form of psi.
  double product(const Matrix& a, const Matrix& b) const {
    return mu * a.cwiseProduct(b).sum() + lambda / 2 * a.trace() * b.trace();
  }
};

}  // namespace tack
