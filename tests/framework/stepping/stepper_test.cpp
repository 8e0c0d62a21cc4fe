// A stepper is one file: this one registers `stepper: free_flight`, which solves nothing and lets
// bodies pass through each other.
#include "framework/stepping/stepper.hpp"

#include <catch2/catch.hpp>

#include "framework/config/describe.hpp"
#include "framework/scene/scene_config.hpp"
#include "framework/world/world.hpp"
#include "geometry/errors.hpp"
#include "tests/support/error_of.hpp"
#include "tests/support/program.hpp"
#include "tests/support/test_run.hpp"
#include "tests/support/warnings.hpp"

using namespace tack;

namespace {

// x + h v + h^2 g.
class FreeFlight : public Stepper {
 public:
  void fields(Fields& f) override {
    f.number("longest", longest_, units::time, "the longest step that is not refused").positive();
    f.number("boost", boost_, units::acceleration, "further acceleration along x, which is not booked as work");
  }
  void admit(const World& world, const SceneConfig&, const TimeConfig&) const override {
    if (world.friction) throw InputError("free_flight knows no friction");
  }
  void prepare(const StepperContext& context) override { world_ = &context.world; }
  void solve(const Step& step, const VecX* /*guess*/, SolveResult& result) override {
    for (int v = 0; v < world_->dofs.vertex_count(); ++v)
      if (world_->dofs.moves(v))
        vertex(result.x, v) =
            vertex(step.state.x, v) + step.h * vertex(step.state.v, v) + step.h * step.h * (world_->gravity + Vec3(boost_, 0, 0));
    world_->participants.move_to(result.x);
    size_ = step.h;
  }
  Validation validate(const SolveResult&) override {
    if (size_ <= longest_) return {};
    return {"too far ahead", "take smaller steps"};
  }

 private:
  double longest_ = 1;  // s
  double boost_ = 0;
  double size_ = 0;     // of the last step [s]
  World* world_ = nullptr;
};

TACK_REGISTER(Stepper, FreeFlight, "free_flight", "Nothing but gravity.", "tests");

constexpr double h = 0.03125, height = 0.3;  // s, m: of the block's lower side

std::string scene_with(const std::string& stepper, const std::string& more = "") {
  return "time: {step: 0.03125, duration: 1, stepper: " + stepper + more + "}\n" +
         "gravity: [0, -9.81, 0]\n"
         "objects:\n"
         "  - {name: floor, shape: {type: box, size: [1, 0.2, 1]}, place: {translate: [0, -0.1, 0]},\n"
         "     motion: [{type: translate, velocity: [0.5, 0, 0]}]}\n"
         "  - {name: block, shape: {type: box, size: [0.2, 0.2, 0.2], cells: [2, 2, 2]}, place: {translate: [0.03, 0.4, 0.02]},\n"
         "     velocity: [0.2, 0, 0], energies: [{type: neo_hookean, young: 1e5}]}\n"
         "contact: {distance: 1 mm}\n";
}

}  // namespace

TEST_CASE("a stepper that solves nothing runs through the loop, and through the floor", "[stepper]") {
  TestRun run(scene_with("free_flight"));
  const VecX start = run.world->start.x;
  const int block = run.world->bodies[1].first_vertex, floor = run.world->bodies[0].first_vertex;
  bool inside = false;
  for (int n = 1; !run.stepper.finished(); ++n) {
    const StepReport report = run.step();
    CHECK(report.rejections.cutbacks() == 0);
    CHECK(report.step_size == h);
    CHECK(report.solve.iterations == 0);
    CHECK(report.intersections == 0);  // the stepper does not check
    REQUIRE(run.state().step == n);
    // Closed form of implicit Euler in a homogeneous field.
    const Vec3 fallen(0.2 * n * h, -9.81 * h * h * n * (n + 1) / 2, 0);
    for (int v = block; v < block + run.world->bodies[1].vertex_count; ++v)
      CHECK((run.at(v) - Vec3(vertex(start, v)) - fallen).norm() < 1e-12 * n * n);
    CHECK((run.at(floor) - Vec3(vertex(start, floor)) - Vec3(0.5 * n * h, 0, 0)).norm() < 1e-12);
    inside = inside || (height + fallen.y() < 0 && height + fallen.y() > -0.2);
  }
  CHECK(inside);
  CHECK(run.state().step == 32);
  CHECK(run.at(block).y() < -4);
  CHECK_FALSE(warned(run.warnings, WarningKind::step_cutback));
}

TEST_CASE("energy gain of a stepper is warned of once", "[stepper]") {
  TestRun run(scene_with("{type: free_flight, boost: 100}"));
  while (!run.stepper.finished()) run.step();
  CHECK_THAT(first_text(run.warnings, WarningKind::energy_growth), Catch::Contains("energy has grown by"));
  CHECK(std::count_if(run.warnings.begin(), run.warnings.end(), [](const Warning& w) { return w.kind == WarningKind::energy_growth; }) == 1);
}

TEST_CASE("the loop cuts back rejected steps, and fails with the remedy of the stepper", "[stepper]") {
  TestRun run(scene_with("{type: free_flight, longest: 0.01}"));
  const StepReport report = run.step();
  CHECK(report.rejections.cutbacks() == 2);
  CHECK(report.step_size == h / 4);
  REQUIRE(run.warnings.size() == 2);
  CHECK_THAT(first_text(run.warnings, WarningKind::step_cutback), Catch::Contains("step 1 at t = 0 s: too far ahead") && Catch::Contains("0.015625 s"));
  TestRun stubborn(scene_with("{type: free_flight, longest: 0.01}", ", max_cutbacks: 1"));
  CHECK_THROWS_WITH(stubborn.step(), Catch::Contains("failed with h = 0.015625 s (too far ahead); take smaller steps"));
  CHECK((stubborn.state().x == stubborn.world->start.x));
}

TEST_CASE("single steps and potentials are those of any stepper", "[stepper]") {
  TestRun run(scene_with("free_flight")), minimized(scene_with("incremental_potential"));
  const SolveResult result = run.stepper.solve(h);
  CHECK(run.stepper.validate(result).fault.empty());
  const SolveResult minimum = minimized.stepper.solve(h);
  // Before contact, free flight is the minimum.
  CHECK((result.x - minimum.x).lpNorm<Eigen::Infinity>() < 1e-5);
  CHECK(run.stepper.potential_at(result.x) == Approx(minimized.stepper.potential_at(minimum.x)));
  run.stepper.commit(result.x, h);
  CHECK((run.state().x == result.x));
}

TEST_CASE("a registered stepper is documented, and its errors are located", "[stepper]") {
  CHECK(contains(list_kind("stepper"), "free_flight"));
  CHECK(contains(list_component("stepper", "free_flight"), "file: tests/framework/stepping/stepper_test.cpp"));
  CHECK(contains(list_component("stepper", "incremental_potential"), "Li et al. 2020"));
  const std::string unknown = error_of<TestRun>(scene_with("free_fligth"));
  CHECK(contains(unknown, "test.yaml:2:"));
  CHECK(contains(unknown, "unknown stepper 'free_fligth'; did you mean 'free_flight'?"));
  std::string rough = scene_with("free_flight");
  rough.replace(rough.find("1 mm}"), 5, "1 mm, friction: {mu: 0.5}}");
  const std::string refused = error_of<TestRun>(rough);
  CHECK(contains(refused, "test.yaml:2:"));
  CHECK(contains(refused, "free_flight knows no friction"));
}
