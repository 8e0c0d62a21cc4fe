// Solids against closed forms: small strains give back E, nu and the moduli that follow from them,
// large ones the material's formula.
#include <Eigen/LU>
#include <catch2/catch.hpp>
#include <cmath>
#include <fmt/format.h>

#include "framework/scene/energy.hpp"
#include "tests/support/component_variants.hpp"
#include "tests/support/dense_term.hpp"
#include "tests/support/tet_body.hpp"

using namespace tack;

namespace {

constexpr double young = 2.5e5;  // Pa

class Solid {
 public:
  Solid(const std::string& type, double poisson)
      : term_(component<Energy>(fmt::format("{{type: {}, young: {}, poisson: {}}}", type, young, poisson))
                  ->make_term(box_.body, box_.rest)) {}

  double density(const Mat3& f) const { return term_->value(box_.deformed(f)) / box_.volume; }

  // First Piola-Kirchhoff stress: sum_v dE/dx_v X_v^T = V P for a homogeneous deformation.
  Mat3 stress(const Mat3& f) const {
    const VecX gradient = dense_gradient(*term_, box_.deformed(f));
    Mat3 sum = Mat3::Zero();
    for (int v = 0; v < box_.body.vertex_count; ++v)
      sum += Vec3(vertex(gradient, v)) * Vec3(vertex(box_.rest, v)).transpose();
    return sum / box_.volume;
  }

  // The lateral stretch of a bar with free sides at an axial stretch a, by Newton on differences.
  double lateral(double a) const {
    double b = 1;
    for (int i = 0; i < 30; ++i) {
      const auto side = [&](double s) { return stress(Vec3(a, s, s).asDiagonal())(1, 1); };
      b -= side(b) / ((side(b + 1e-6) - side(b - 1e-6)) / 2e-6);
    }
    return b;
  }

 private:
  TetBody box_{Vec3(0.3, 0.2, 0.1), {2, 2, 1}};
  std::unique_ptr<Term> term_;
};

const std::vector<std::string> solids = {"neo_hookean", "fixed_corotated", "stvk_hencky"};

}  // namespace

TEST_CASE("a slightly stretched bar shows E and nu", "[solids]") {
  for (const std::string& type : solids) {
    for (const double nu : {0.0, 0.3, 0.49, -0.4}) {
      INFO(type << ", nu = " << nu);
      const Solid solid(type, nu);
      constexpr double e = 1e-5;
      // The mean of tension and compression has an error of second order in e.
      double modulus = 0, contraction = 0;
      for (const double strain : {e, -e}) {
        const double b = solid.lateral(1 + strain);
        modulus += solid.stress(Vec3(1 + strain, b, b).asDiagonal())(0, 0) / strain / 2;
        contraction += (1 - b) / strain / 2;
      }
      CHECK(modulus == Approx(young).epsilon(1e-7));
      CHECK(contraction == Approx(nu).margin(1e-7));
    }
  }
}

TEST_CASE("small shear and small dilation show the shear and bulk moduli", "[solids]") {
  for (const std::string& type : solids) {
    for (const double nu : {0.0, 0.3, 0.49}) {
      INFO(type << ", nu = " << nu);
      const Solid solid(type, nu);
      const double mu = young / (2 * (1 + nu)), bulk = young / (3 * (1 - 2 * nu));
      constexpr double e = 1e-5;
      Mat3 shear = Mat3::Zero();
      shear(0, 1) = e;
      const Mat3 identity = Mat3::Identity();
      const Mat3 sheared = (solid.stress(identity + shear) - solid.stress(identity - shear)) / (2 * e);
      CHECK(sheared(0, 1) == Approx(mu).epsilon(1e-7));
      CHECK(sheared(1, 0) == Approx(mu).epsilon(1e-7));
      const Mat3 swollen = (solid.stress((1 + e) * identity) - solid.stress((1 - e) * identity)) / (2 * e);
      CHECK(swollen.trace() / 9 == Approx(bulk).epsilon(1e-7));
      CHECK(std::abs(swollen(0, 1)) <= 1e-7 * young);
    }
  }
}

// Barrier of fixed_corotated, below a tenth of the volume.
double crushed_barrier(double j, double mu, double lambda) {
  const double r = j / 0.1;
  return r < 1 ? -(lambda + 2 * mu) * 0.1 * (1 - r) * (1 - r) * std::log(r) : 0;
}

TEST_CASE("large deformations have the energy of the formula", "[solids]") {
  constexpr double nu = 0.3;
  const double mu = young / (2 * (1 + nu)), lambda = young * nu / ((1 + nu) * (1 - 2 * nu));
  RandomMotions random(8);
  for (int trial = 0; trial < 50; ++trial) {
    const Vec3 s(random.uniform(0.2, 3), random.uniform(0.2, 3), random.uniform(0.2, 3));
    const Mat3 f = random.rotation() * s.asDiagonal() * random.rotation().transpose();
    const double j = s.prod(), log_j = std::log(j);
    const Vec3 log_s = s.array().log();
    CHECK(Solid("neo_hookean", nu).density(f) ==
          Approx(mu / 2 * (s.squaredNorm() - 3) - mu * log_j + lambda / 2 * log_j * log_j));
    CHECK(Solid("fixed_corotated", nu).density(f) ==
          Approx(mu * (s - Vec3::Ones()).squaredNorm() + lambda / 2 * (j - 1) * (j - 1) + crushed_barrier(j, mu, lambda)));
    CHECK(Solid("stvk_hencky", nu).density(f) ==
          Approx(mu * log_s.squaredNorm() + lambda / 2 * log_j * log_j));
  }
}

TEST_CASE("a solid cannot be flattened", "[solids]") {
  for (const std::string& type : solids) {
    INFO(type);
    const Solid solid(type, 0.3);
    const auto resistance = [&](double s) {
      const double step = 1e-6 * s;
      return (solid.density(Mat3(Vec3(1, s - step, 1).asDiagonal())) - solid.density(Mat3(Vec3(1, s + step, 1).asDiagonal()))) / (2 * step);
    };
    double before = 0;
    for (const double s : {0.05, 0.01, 1e-3, 1e-4, 1e-5}) {
      const double pressure = resistance(s);
      CHECK(pressure > 1.5 * before);
      before = pressure;
    }
    CHECK(before > 1e3 * young);
  }
}

TEST_CASE("inverted solids have infinite energy", "[solids]") {
  for (const std::string& type : solids) {
    CHECK(std::isinf(Solid(type, 0.3).density(Vec3(1, 1, -1).asDiagonal())));
    CHECK(std::isinf(Solid(type, 0.3).density(Mat3(Vec3(1, 1, 0).asDiagonal()))));
  }
}
