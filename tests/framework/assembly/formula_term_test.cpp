#include "framework/assembly/formula_term.hpp"

#include <catch2/catch.hpp>
#include <random>

#include "framework/assembly/pair_spring.hpp"
#include "tests/support/dense_term.hpp"

using namespace tack;

namespace {

struct Stretch : FormulaOf<2> {
  struct Data {
    double stiffness, length;
  };
  template <class T>
  T energy(const Positions<T>& x, const Data& d) const {
    const T stretch = (x[1] - x[0]).norm() - d.length;
    return 0.5 * d.stiffness * stretch * stretch;
  }
};

// A formula of four positions and two scalars: a dihedral angle with a target angle, built from all
// operations of scalars.
struct Hinge : FormulaOf<6, 2> {
  struct Data {
    double stiffness;
  };
  template <class T>
  T energy(const Positions<T>& x, const Data& d) const {
    const Eigen::Matrix<T, 3, 1> axis = x[1] - x[0], m = axis.cross(x[2] - x[0]), n = (x[3] - x[0]).cross(axis);
    const T angle = atan2(m.cross(n).dot(axis) / axis.norm(), m.dot(n)), off = angle - x[4].x() * exp(-x[5].x());
    return d.stiffness * (off * off + 0.1 * cos(x[4].x()) + 0.3 * tanh(x[5].x() * sqrt(axis.squaredNorm()))) - log(2.0 + sin(x[4].x())) / (1.0 + pow(axis.norm(), 1.5)) +
           abs(acos(0.3 * cos(x[5].x())));
  }
};

struct Wide : FormulaOf<largest_arity> {
  struct Data {};
  template <class T>
  T energy(const Positions<T>& x, const Data&) const {
    T sum = 0;
    for (int i = 1; i < arity; ++i) sum += pow((x[i] - x[i - 1]).squaredNorm(), 1.5) * (x[0] - x[i]).dot(x[1] - x[i]);
    return sum;
  }
};

VecX random_places(int vertices) {
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> one(-1, 1);
  return VecX::NullaryExpr(3 * vertices, [&] { return one(generator); });
}

void check_derivatives(const Term& term, const VecX& x) {
  const VecX slopes = gradient_by_differences([&](const VecX& y) { return term.value(y); }, x, 1e-4);
  CHECK((slopes - dense_gradient(term, x)).norm() <= 1e-9 * slopes.norm());
  const MatX curvatures = hessian_by_differences([&](const VecX& y) { return dense_gradient(term, y); }, x, 1e-4);
  CHECK((curvatures - dense_hessian(term, x, Projection::none)).norm() <= 1e-8 * curvatures.norm());
}

}  // namespace

TEST_CASE("terms of a formula: derivatives are those of the formula, of any arity, with scalars", "[formula_term]") {
  FormulaTerm<Stretch> stretch("stretch");
  stretch.add({0, 2}, {3, 0.5});
  stretch.add({1, 2}, {2, 4});
  check_derivatives(stretch, random_places(3));
  FormulaTerm<Hinge> hinge("hinge");
  hinge.add({0, 1, 2, 3, 4, 5}, {2});
  hinge.add({3, 1, 0, 2, 5, 4}, {1});
  check_derivatives(hinge, random_places(6));
  FormulaTerm<Wide> wide("wide");
  wide.add({0, 1, 2, 3, 4, 5, 6, 7, 8, 9}, {});
  check_derivatives(wide, random_places(10));
}

TEST_CASE("a spring as a formula equals the hand-written term", "[formula_term]") {
  const VecX x = random_places(2);
  const Vec3 span = vertex(x, 1) - vertex(x, 0);
  for (const double length : {0.1, 5.0})
    for (const Projection projection : {Projection::none, Projection::clamp, Projection::absolute}) {
      FormulaTerm<Stretch> term("stretch");
      term.add({0, 1}, {3, length});
      VecX gradient(6), by_hand(6), hessian(27), hessian_by_hand(27);
      term.derivatives(x, projection, gradient.data(), hessian.data());
      PairSpring{3, length}.derivatives(span, projection, by_hand.data(), hessian_by_hand.data());
      CHECK((gradient - by_hand).norm() <= 1e-13 * by_hand.norm());
      CHECK((hessian - hessian_by_hand).norm() <= 1e-12 * hessian_by_hand.norm());
    }
}

TEST_CASE("stencils with scalars are projected in all displacements that change the energy", "[formula_term]") {
  FormulaTerm<Hinge> hinge("hinge");
  hinge.add({0, 1, 2, 3, 4, 5}, {2});
  const VecX x = random_places(6);
  const MatX exact = dense_hessian(hinge, x, Projection::none);
  REQUIRE(smallest_eigenvalue(exact) < -1e-3 * exact.norm());
  for (const Projection projection : {Projection::clamp, Projection::absolute})
    CHECK((dense_hessian(hinge, x, projection) - projected(exact, projection)).norm() <= 1e-12 * exact.norm());
}
