#include "framework/scene/derivative_check.hpp"

#include <catch2/catch.hpp>

#include "tests/support/scene.hpp"
#include "tests/support/tiny_scene.hpp"

using namespace tack;

namespace {

// Springs from the origin to the first free vertices, 1/2 |x|^2, with a slope and a curvature that may be off.
class Springs : public Term {
 public:
  Springs(const DofMap& dofs, double slope, double curvature)
      : Term("springs"), slope_(slope), curvature_(curvature) {
    for (int b = 0; b < 2; ++b) vertices_.push_back(dofs.vertex_of_block(b));
  }
  double value(const VecX& x) const override {
    const Vec3 d = vertex(x, vertices_[0]) - vertex(x, vertices_[1]);
    return 0.5 * d.squaredNorm();
  }
  std::vector<StencilBatch> batches() const override { return {{2, 1, vertices_.data()}}; }
  void derivatives(const VecX& x, SpdFilter, double* gradient, double* hessian) const override {
    const Vec3 d = slope_ * (vertex(x, vertices_[0]) - vertex(x, vertices_[1]));
    Eigen::Map<Vec3>{gradient} = d;
    Eigen::Map<Vec3>{gradient + 3} = -d;
    if (!hessian) return;
    Eigen::Map<Mat3>{hessian} = curvature_ * Mat3::Identity();
    Eigen::Map<Mat3>{hessian + 9} = -curvature_ * Mat3::Identity();
    Eigen::Map<Mat3>{hessian + 18} = curvature_ * Mat3::Identity();
  }

 private:
  std::vector<int> vertices_;
  double slope_, curvature_;
};

DerivativeCheck check_springs(double slope, double curvature) {
  TestScene scene(tiny_scene.substr(tiny_scene.find('\n') + 1));
  const Springs springs(scene.world->dofs, slope, curvature);
  scene.world->terms = {&springs};
  return check_derivatives(*scene.world, 0.01, scene.clock).at(0);
}

}  // namespace

TEST_CASE("derivatives that are those of the value pass", "[scene]") {
  TestScene scene(tiny_scene.substr(tiny_scene.find('\n') + 1));
  const auto checks = check_derivatives(*scene.world, 0.01, scene.clock);
  CHECK(checks.size() == scene.world->terms.size());
  for (const DerivativeCheck& c : checks) {
    INFO(c.term << ": " << c.gradient_error << ", " << c.hessian_error);
    CHECK_FALSE(c.wrong());
  }
  CHECK_FALSE(check_springs(1, 1).wrong());
}

TEST_CASE("derivatives that are not are told", "[scene]") {
  CHECK(check_springs(1.01, 1.01).wrong());
  CHECK(check_springs(1, 2).wrong());
  CHECK(check_springs(1, 1).term == "springs");
}
