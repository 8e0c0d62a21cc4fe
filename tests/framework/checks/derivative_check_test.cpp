#include "framework/checks/derivative_check.hpp"

#include <catch2/catch.hpp>

#include "framework/contact/terms/contact_term.hpp"
#include "tests/support/program.hpp"
#include "tests/support/scene.hpp"
#include "tests/support/tiny_scene.hpp"

using namespace tack;

namespace {

// Another term with slots of its gradient and Hessian multiplied by factors.
class Spoilt : public Term {
 public:
  struct Factors {
    double gradient = 1, hessian = 1;              // of all slots
    double gradient_entry = 1, hessian_entry = 1;  // of one
  };
  Spoilt(const Term& right, Factors factors) : Term("spoilt"), right_(right), factors_(factors) {}
  double value(const VecX& x) const override { return right_.value(x); }
  std::vector<StencilBatch> batches() const override { return right_.batches(); }
  bool dynamic() const override { return right_.dynamic(); }
  void derivatives(const VecX& x, Projection projection, double* gradient, double* hessian) const override {
    right_.derivatives(x, projection, gradient, hessian);
    int vectors = 0, blocks = 0;
    for (const StencilBatch& b : batches()) {
      vectors += b.arity * b.count;
      blocks += hessian_blocks(b.arity) * b.count;
    }
    if (vectors == 0) return;
    Eigen::Map<VecX>(gradient, 3 * vectors) *= factors_.gradient;
    gradient[largest(gradient, 3 * vectors)] *= factors_.gradient_entry;
    if (!hessian) return;
    Eigen::Map<VecX>(hessian, 9 * blocks) *= factors_.hessian;
    hessian[largest(hessian, 9 * blocks)] *= factors_.hessian_entry;
  }

 private:
  static int largest(const double* slots, int n) {
    Eigen::Index at = 0;
    Eigen::Map<const VecX>(slots, n).cwiseAbs().maxCoeff(&at);
    return static_cast<int>(at);
  }
  const Term& right_;
  Factors factors_;
};

// A value without derivatives, or derivatives without a value, on the springs between two vertices.
class Half : public Term {
 public:
  Half(const DofMap& dofs, double value, double slope) : Term("half"), value_(value), slope_(slope) {
    for (int b = 0; b < 2; ++b) vertices_[b] = dofs.vertex_of_block(b);
  }
  double value(const VecX& x) const override { return 0.5 * value_ * stretch(x).squaredNorm(); }
  std::vector<StencilBatch> batches() const override { return {{2, 1, vertices_}}; }
  void derivatives(const VecX& x, Projection, double* gradient, double* hessian) const override {
    Eigen::Map<Vec3>{gradient} = slope_ * stretch(x);
    Eigen::Map<Vec3>{gradient + 3} = -slope_ * stretch(x);
    if (!hessian) return;
    for (int b = 0; b < 3; ++b)
      Eigen::Map<Mat3>{hessian + 9 * b} = (b == 1 ? -slope_ : slope_) * Mat3::Identity();
  }

 private:
  Vec3 stretch(const VecX& x) const { return vertex(x, vertices_[0]) - vertex(x, vertices_[1]); }
  int vertices_[2];
  double value_, slope_;
};

std::string scene_text(const std::string& part, const std::string& other) {
  const std::string scene = tiny_scene_with(part, other);
  return scene.substr(scene.find('\n') + 1);
}

const std::string plain = tiny_scene.substr(tiny_scene.find('\n') + 1);

// Scenes in which differences are hard to take: a gap of 1e-9 m, a sliver, far from the origin.
std::string moved_away() {
  std::string text = scene_text("[0, -0.1, 0]", "[1e6, -0.1, 1e6]");
  const std::string block = "[0, 0.1006, 0]";
  return text.replace(text.find(block), block.size(), "[1e6, 0.1006, 1e6]");
}
const std::vector<std::string> hard_scenes = {
    scene_text("[0, 0.1006, 0]", "[0, 0.100000001, 0]"),
    scene_text("[0, 0.1006, 0]", "[0, 0.1006, 0], scale: [1, 1, 1e-5]"),
    moved_away()};

std::vector<DerivativeCheck> checks_of(TestScene& scene) {
  return check_derivatives(*scene.world, 0.01, scene.clock);
}

const Term& term_named(const World& world, const std::string& name) {
  for (const Term* term : world.terms)
    if (term->name() == name) return *term;
  throw std::logic_error(name);
}

DerivativeCheck spoilt(const std::string& text, const std::string& name, Spoilt::Factors factors) {
  TestScene scene(text);
  const Spoilt term(term_named(*scene.world, name), factors);
  scene.world->terms = {&term};
  return check_derivatives(*scene.world, 0.01, scene.clock).at(0);
}

DerivativeCheck half(double value, double slope) {
  TestScene scene(plain);
  const Half term(scene.world->dofs, value, slope);
  scene.world->terms = {&term};
  return check_derivatives(*scene.world, 0.01, scene.clock).at(0);
}

}  // namespace

TEST_CASE("derivatives that are those of the value pass, also at tiny gaps, in slivers and far away", "[scene]") {
  std::vector<std::string> texts = hard_scenes;
  texts.push_back(plain);
  for (const std::string& text : texts) {
    INFO(text);
    TestScene scene(text);
    const auto checks = checks_of(scene);
    CHECK(checks.size() == scene.world->terms.size());
    for (const DerivativeCheck& c : checks) {
      INFO(c.term << ": " << c.gradient.error << ", " << c.hessian.error);
      CHECK_FALSE(c.wrong());
      CHECK(c.active() == (c.term != "overhangs"));  // surfaces of different size
      CHECK(c.gradient.unclear == 0);
      CHECK(20 * c.hessian.unclear <= c.hessian.components);
    }
  }
}

TEST_CASE("derivatives with errors of three percent are found, in all entries or in one", "[scene]") {
  for (const char* name : {"neo_hookean", "contact"}) {
    INFO(name);
    CHECK_FALSE(spoilt(plain, name, {}).wrong());
    CHECK(spoilt(plain, name, {.gradient = 1.03, .hessian = 1.03}).gradient.wrong);
    CHECK(spoilt(plain, name, {.hessian = 1.03}).hessian.wrong);
    CHECK(spoilt(plain, name, {.hessian = 0.97}).hessian.wrong);
    CHECK(spoilt(plain, name, {.gradient_entry = 1.03}).gradient.wrong);
    CHECK(spoilt(plain, name, {.hessian_entry = 1.03}).hessian.wrong);
  }
}

TEST_CASE("one wrong entry is found in a mesh of a thousand vertices", "[scene]") {
  const std::string text = scene_text("size: [0.2, 0.2, 0.2]", "size: [0.2, 0.2, 0.2], cells: [9, 9, 9]");
  CHECK_FALSE(spoilt(text, "neo_hookean", {}).wrong());
  CHECK(spoilt(text, "neo_hookean", {.gradient_entry = 1.03}).gradient.wrong);
  CHECK(spoilt(text, "neo_hookean", {.hessian_entry = 1.03}).hessian.wrong);
}

TEST_CASE("wrong derivatives are found at tiny gaps, in slivers and far from the origin", "[scene]") {
  for (const std::string& text : hard_scenes) {
    INFO(text);
    for (const char* name : {"neo_hookean", "contact"}) {
      INFO(name);
      CHECK(spoilt(text, name, {.gradient = 1.03, .hessian = 1.03}).gradient.wrong);
      CHECK(spoilt(text, name, {.hessian = 1.03}).hessian.wrong);
    }
  }
}

TEST_CASE("a term that is zero is inactive; half a term is wrong", "[scene]") {
  TestScene scene(scene_text("[0, 0.1006, 0]", "[0, 0.3, 0]"));
  for (const DerivativeCheck& c : checks_of(scene)) CHECK(c.active() == (c.term != "contact" && c.term != "rim" && c.term != "overhangs"));
  CHECK_FALSE(half(0, 0).active());
  CHECK_FALSE(half(0, 0).wrong());
  CHECK_FALSE(half(1, 1).wrong());
  CHECK(half(1, 0).wrong());
  CHECK(half(0, 1).wrong());
}

TEST_CASE("a term that constraints leave no motion is inactive", "[scene]") {
  const std::string joint = GENERATE("{type: slider, object: ball, at: [0, 0.001, 0], axis: [0, 1, 0]}", "{type: slider, object: ball, at: [0.02, 0, 0.01], axis: [1, 2, 3]}");
  TestScene scene(R"(time: {step: 5 ms}
objects:
  - name: ball
    shape: {type: box, size: [0.01, 0.003, 0.001]}
    place: {translate: [0.001, 0.2, 0]}
    body: {type: affine, density: 7800, stiffness: 1e9}
interactions:
  - )" + joint + "\n");
  for (const DerivativeCheck& c : checks_of(scene)) {
    INFO(c.term);
    CHECK_FALSE(c.wrong());
    if (c.term == "affine") CHECK_FALSE(c.active());
  }
}

TEST_CASE("directions that are fixed give inactive terms no Hessian", "[scene]") {
  // Planes of symmetry at an angle, as of a sector; the ball on the slider has no strain.
  TestScene scene(R"(time: {step: 5 ms}
objects:
  - name: layer
    shape: {type: box, size: [0.01, 0.003, 0.01], cells: [2, 1, 2]}
    energies: [{type: neo_hookean, young: 50 kPa, poisson: 0.3, density: 1000}]
    motion: [{type: fixed, along: [0.6, 0, 0.8], select: {type: face, direction: [1, 0, 0]}}]
  - name: ball
    shape: {type: box, size: [0.01, 0.003, 0.001]}
    place: {translate: [0.001, 0.2, 0]}
    body: {type: affine, density: 7800, stiffness: 1e9}
interactions:
  - {type: slider, object: ball, at: [0, 0.001, 0], axis: [0, 1, 0]}
  - {type: spring, from: {object: ball, select: {type: formula, where: x < 0 && y < 0.2 && z < 0}}, to: {object: layer, select: {type: formula, where: x < 0 && y > 0 && z < 0}}, stiffness: 30}
contact: {distance: 1 mm}
)");
  int active = 0;
  for (const DerivativeCheck& c : checks_of(scene)) {
    INFO(c.term);
    CHECK_FALSE(c.wrong());
    CHECK(c.active() == (c.term == "neo_hookean" || c.term == "springs"));
    active += c.active();
  }
  CHECK(active == 2);
}

TEST_CASE("tack check reports a term that is zero as inactive", "[scene][app]") {
  const TemporaryFolder folder;
  write_file(folder.path() / "far.yaml", tiny_scene_with("[0, 0.1006, 0]", "[0, 0.3, 0]"));
  const ProgramResult result = run_tack(folder.path(), {"check", "far.yaml"});
  CHECK(result.exit_code == 0);
  CHECK(contains(result.out, "derivatives of contact: inactive"));
  CHECK(contains(result.out, "derivatives of gravity: gradient error"));
}
