// Every status that a registered minimizer may end with, provoked on a function of three unknowns.
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "geometry/interrupt.hpp"
#include "framework/core/minimizer.hpp"
#include "framework/core/residual_view.hpp"
#include "tests/support/component_variants.hpp"

using namespace tack;

namespace {

// sum of c(x_i) with slope and curvature as given; c = root^2 / 2 + constant for methods that want squares.
struct Curve {
  double (*value)(double);
  double (*slope)(double);
  double (*curvature)(double);
  double (*root)(double) = [](double) { return 0.0; };
  double (*root_slope)(double) = [](double) { return 1.0; };
};

class Separable : public Objective, private ResidualView {
 public:
  explicit Separable(const Curve& curve) : curve_(curve) {
    matrix_.column_start = {0, 1};
    matrix_.row = {0};
    matrix_.values.assign(9, 0.0);
    matrix_.version = 1;
  }
  int size() const override { return 3; }
  void move_to(const VecX& q) override { q_ = q; }
  double value() override {
    ++count_;
    return curve_.value(q_(0)) + curve_.value(q_(1)) + curve_.value(q_(2));
  }
  double value_noise() const override { return 0; }
  const VecX& gradient() override { return gradient_ = q_.unaryExpr(curve_.slope); }
  const BlockMatrix& hessian(const HessianRequest&) override {
    gradient();
    matrix_.block(0) = Vec3(q_.unaryExpr(curve_.curvature)).asDiagonal();
    return matrix_;
  }
  int value_count() const override { return count_; }
  LeastSquares least_squares() const override { return {{this}, {1.0}, dofs_, q_, no_mass_}; }

 private:
  std::vector<ResidualBatch> residual_batches() const override { return {{1, 3, 1, &vertex_}}; }
  bool residuals(const VecX& x, double* r, double* jacobian) const override {
    Eigen::Map<Vec3>{r} = x.unaryExpr(curve_.root);
    if (jacobian) Eigen::Map<Mat3>{jacobian} = Vec3(x.unaryExpr(curve_.root_slope)).asDiagonal();
    return true;
  }

  Curve curve_;
  int vertex_ = 0;
  DofMap dofs_{std::vector<char>{1}};
  VecX no_mass_ = VecX::Zero(1);
  VecX q_, gradient_;
  BlockMatrix matrix_;
  int count_ = 0;
};

const Curve bowl = {[](double x) { return std::cosh(x); }, [](double x) { return std::sinh(x); },
                    [](double x) { return std::cosh(x); }, [](double x) { return 2 * std::sinh(x / 2); },
                    [](double x) { return std::cosh(x / 2); }};

struct Ended {
  MinimizerResult result;
  VecX q;
  int values;
};

Ended minimize(const std::string& type, const Curve& curve, double feasible = 1, int max_iterations = 300,
               const Vec3& start = {1, 2, 3}) {
  Separable objective(curve);
  PhaseClock clock;
  const auto minimizer =
      component<Minimizer>("{type: " + type + ", max_iterations: " + std::to_string(max_iterations) + "}");
  VecX q = start;
  const MinimizerResult result = minimizer->minimize(
      {objective, [&](const VecX&, const VecX&) { return feasible; },
       [](const VecX& p, const VecX&) { return p.lpNorm<Eigen::Infinity>() / 1e-6; }, clock},
      q);
  return {result, q, objective.value_count()};
}

}  // namespace

TEST_CASE("statuses of minimizers", "[minimizer]") {
  const std::string type = GENERATE(from_range(Registry<Minimizer>::kind().names()));
  INFO(type);
  SECTION("converged") {
    const Ended e = minimize(type, bowl);
    CHECK(e.result.status == MinimizerStatus::converged);
    CHECK(e.result.residual <= 1);
    CHECK(e.q.norm() < 1e-5);
  }
  SECTION("iteration limit reached, with the budget kept") {
    const Ended e = minimize(type, bowl, 1, 2);
    CHECK(e.result.status == MinimizerStatus::iteration_limit);
    CHECK(e.result.iterations == 2);
    CHECK(e.values <= 20);
    CHECK(e.q.norm() < Vec3(1, 2, 3).norm());  // the decrease stays
  }
  SECTION("line search failed: the slope lies") {
    const Curve liar = {[](double x) { return x; }, [](double) { return -1.0; }, [](double) { return 1.0; }};
    const Ended e = minimize(type, liar);
    CHECK(e.result.status == MinimizerStatus::line_search_failed);
    CHECK(e.q == Vec3(1, 2, 3));
  }
  SECTION("blocked: no step is feasible") {
    CHECK(minimize(type, bowl, 0).result.status == MinimizerStatus::blocked);
  }
  SECTION("factorization failed") {
    const Curve broken = {bowl.value, bowl.slope, [](double) { return std::nan(""); }};
    const MinimizerStatus status = minimize(type, broken).result.status;
    // External methods use no factorisation: without a convergence test they never converge.
    const bool external = type == "nlopt" || type.rfind("ceres", 0) == 0;
    if (external) CHECK(status != MinimizerStatus::converged);
    else CHECK(status == MinimizerStatus::factorization_failed);
  }
  SECTION("not finite") {
    const Curve broken = {bowl.value, [](double) { return std::nan(""); }, bowl.curvature};
    CHECK(minimize(type, broken).result.status == MinimizerStatus::not_finite);
  }
  SECTION("interrupted") {
    interrupt_requested = true;
    const Ended e = minimize(type, bowl);
    interrupt_requested = false;
    CHECK(e.result.status == MinimizerStatus::interrupted);
    CHECK(e.q == Vec3(1, 2, 3));
  }
}

TEST_CASE("a point with unbalanced forces is no minimum", "[minimizer]") {
  const std::string type = GENERATE(from_range(Registry<Minimizer>::kind().names()));
  INFO(type);
  const auto minimizer = component<Minimizer>("{type: " + type + ", max_iterations: 3000}");
  const auto ended = [&](double tolerated) {
    Separable objective(bowl);
    PhaseClock clock;
    MinimizerProblem problem{objective, [](const VecX&, const VecX&) { return 1.0; },
                             [](const VecX& p, const VecX&) { return p.lpNorm<Eigen::Infinity>() / 0.1; }, clock};
    problem.force_residual = [&](const VecX& g) { return g.lpNorm<Eigen::Infinity>() / tolerated; };
    VecX q = Vec3(1, 2, 3);
    const MinimizerResult result = minimizer->minimize(problem, q);
    return std::pair(result, q.lpNorm<Eigen::Infinity>());
  };
  const auto [loose, far] = ended(1e9);
  CHECK(loose.status == MinimizerStatus::converged);
  const auto [balanced, near] = ended(1e-8);
  CHECK(balanced.status == MinimizerStatus::converged);
  CHECK(near < 1.1e-8);
  CHECK(balanced.iterations >= loose.iterations);
  const auto [never, nearest] = ended(0);
  CHECK((never.status != MinimizerStatus::converged || nearest == 0));
}

// A shifted system gives a short step wherever it is taken: short steps are no proof of a minimum.
TEST_CASE("an indefinite Hessian leads on to a minimum, not to a claim of one", "[minimizer]") {
  const Curve wells = {[](double x) { return x * x * (x * x / 4 - 0.5); }, [](double x) { return x * (x * x - 1); },
                       [](double x) { return 3 * x * x - 1; }};
  for (const char* projection : {"none", "clamp", "contacts", "absolute", "on_demand", "progressive", "adaptive"}) {
    INFO(projection);
    const Ended e = minimize(std::string("projected_newton, projection: ") + projection, wells, 1, 300, Vec3(1e-7, 1e-7, 1e-7));
    CHECK(e.result.status == MinimizerStatus::converged);
    CHECK((e.q.cwiseAbs() - Vec3(1, 1, 1)).norm() < 1e-5);
  }
}

// A projected Hessian after much clamping: Newton's steps alone would leave 0.95 of the distance each.
TEST_CASE("steps of Hessians that are too stiff are extrapolated within the feasible length", "[minimizer]") {
  const std::string type = GENERATE("projected_newton", "newton_pcg");
  const Curve stiff = {[](double x) { return x * x / 2; }, [](double x) { return x; }, [](double) { return 20.0; }};
  const Ended free = minimize(type, stiff);
  CHECK(free.result.status == MinimizerStatus::converged);
  CHECK(free.result.iterations < 5);
  // An obstacle that blocks a step blocks its extrapolation.
  const double never_whole = 0.2;
  const Ended blocked = minimize(type, stiff, never_whole, 10);
  CHECK(blocked.result.status == MinimizerStatus::iteration_limit);
  CHECK(blocked.q(0) == Approx(std::pow(1 - never_whole / 20, 10)));
}

// Curvatures of 1, 4 and 16, each for an unknown of its own, where the Hessian says 20: steepest descents, however long,
// go to and fro.
TEST_CASE("steps of Hessians that are too stiff are made conjugate", "[minimizer]") {
  const std::string type = GENERATE("projected_newton", "newton_pcg");
  static const auto bottom = [](double x) { return x < 5 ? 0.0 : x < 15 ? 10.0 : 20.0; };
  static const auto curvature = [](double x) { return x < 5 ? 1.0 : x < 15 ? 4.0 : 16.0; };
  const Curve uneven = {[](double x) { return curvature(x) * std::pow(x - bottom(x), 2) / 2; },
                        [](double x) { return curvature(x) * (x - bottom(x)); }, [](double) { return 20.0; }};
  const Ended e = minimize(type, uneven, 1, 300, Vec3(1, 9, 21));
  CHECK(e.result.status == MinimizerStatus::converged);
  CHECK((e.q - Vec3(0, 10, 20)).norm() < 1e-4);
  CHECK(e.result.iterations < 10);
}
