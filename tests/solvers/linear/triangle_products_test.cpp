// Products with small triangles against Eigen's.
#include "solvers/linear/triangle_products.hpp"

#include <catch2/catch.hpp>

#include <Eigen/Dense>

using namespace tack;

TEMPLATE_TEST_CASE("small triangles times vectors", "[linear]", float, double) {
  using Vector = Eigen::Matrix<TestType, Eigen::Dynamic, 1>;
  using Matrix = Eigen::Matrix<TestType, Eigen::Dynamic, Eigen::Dynamic>;
  for (int n = 1; n <= triangle_columns<TestType>; ++n) {
    INFO(n << " columns");
    // A panel with rows below the triangle, which do not count.
    const int height = n + 5;
    Vector storage = Vector::Random(height * n + triangle_overrun<TestType>);
    Eigen::Map<Matrix> panel(storage.data(), height, n);
    panel.topRows(n).template triangularView<Eigen::StrictlyUpper>().setZero();
    const Matrix lower = panel.topRows(n);
    const Vector x = Vector::Random(n);
    Vector y(n + 1);  // later entries are unchanged
    y << x, TestType(7);
    lower_times(n, storage.data(), height, y.data());
    CHECK((y.head(n) - lower * x).norm() < 1e-6 * x.norm() * lower.norm());
    CHECK(y(n) == 7);
    y << x, TestType(7);
    lower_transposed_times(n, storage.data(), height, y.data());
    CHECK((y.head(n) - lower.transpose() * x).norm() < 1e-6 * x.norm() * lower.norm());
    CHECK(y(n) == 7);
  }
}
