// `tack new`: each template is written, passes `tack check`, runs as its `expect` says, and fails where the run is spoilt.
#include <catch2/catch.hpp>

#include "framework/catalogue/scene_templates.hpp"
#include "tests/support/program.hpp"

namespace tack {
namespace {

struct Spoilt {
  const char* name;        // of the template
  Arguments overrides;     // that spoil the run
  std::string expectation;  // which then fails
};

// The overrides change the machine, a law or an object, but not the parameters that the expectations compare with.
const std::vector<Spoilt> spoilt = {
    {"drape", {"objects.ball.shape.radius=5 cm", "objects.ball.place.translate=[2, 0, 0]"}, "the ball carries the weight"},
    {"lap-shear", {"interactions.0.stiffness=machine_stiffness / 4"}, "stiffness of layer, bonds and machine in series"},
    {"peel", {"contact.pairs.0.adhesion.work_of_adhesion=4 J/m^2"}, "the force of Kendall"},
    {"probe-tack", {"interactions.0.stiffness=machine_stiffness / 40"}, "the machine's spring carries it"},
    {"stack", {"objects.upper.place.translate=[0.7 * size, 2.5 * size + 3 * drop, 0]"}, "the stack stands"}};

Arguments run_of(const std::string& scene) { return {"run", scene, "-o", "out", "--set", "output.frames=false"}; }

TEST_CASE("every template has a trial that its expectations catch", "[catalogue]") {
  const std::vector<SceneTemplate> templates = scene_templates(template_folder());
  REQUIRE(templates.size() == spoilt.size());
  for (size_t i = 0; i < spoilt.size(); ++i) CHECK(templates[i].name == spoilt[i].name);
}

TEST_CASE("templates are listed, written, and never over a file", "[catalogue]") {
  const TemporaryFolder folder;
  const auto tack = [&](const Arguments& arguments) { return run_tack(folder.path(), arguments); };
  const ProgramResult list = tack({"new"});
  CHECK(list.exit_code == 0);
  for (const Spoilt& s : spoilt) CHECK(contains(list.out, s.name));
  CHECK(contains(list.out, "  probe-tack  A probe-tack test: a flat probe"));
  CHECK(contains(tack({"new", "probe_tak"}).err, "unknown template 'probe_tak'; did you mean 'probe-tack'?"));
  CHECK(tack({"new", "stack"}).exit_code == 0);
  CHECK(std::filesystem::exists(folder.path() / "stack.yaml"));
  const ProgramResult again = tack({"new", "stack"});
  CHECK(again.exit_code == 2);
  CHECK(contains(again.err, "stack.yaml: is there already, and is not replaced; choose another file with -o"));
  CHECK(tack({"new", "-o", "a.yaml"}).exit_code == 2);
  CHECK(tack({"new", "stack", "-o", "no/such/folder/a.yaml"}).exit_code == 2);
  CHECK(contains(tack({"list", "stack"}).out, "tack new NAME"));
}

TEST_CASE("templates are right, and their expectations can fail", "[catalogue]") {
  for (const Spoilt& s : spoilt) {
    INFO(s.name);
    const TemporaryFolder folder;
    const auto tack = [&](const Arguments& arguments) { return run_tack(folder.path(), arguments); };
    REQUIRE(tack({"new", s.name, "-o", "scene.yaml"}).exit_code == 0);
    const std::string text = file_text(folder.path() / "scene.yaml");
    CHECK(contains(text, "docs/scene.schema.json\n"));
    CHECK(contains(text, "\nparameters:\n"));
    CHECK(text.find("\nparameters:") < text.find("\nobjects:"));
    const ProgramResult checked = tack({"check", "scene.yaml"});
    INFO(checked.out << checked.err);
    CHECK(checked.exit_code == 0);
    CHECK_FALSE(contains(checked.out, "warning: "));
    const ProgramResult run = tack(run_of("scene.yaml"));
    INFO(run.out << run.err);
    CHECK(run.exit_code == 0);
    Arguments arguments = run_of("scene.yaml");
    arguments.insert(arguments.end(), s.overrides.begin(), s.overrides.end());
    const ProgramResult wrong = tack(arguments);
    INFO(wrong.out << wrong.err);
    CHECK(wrong.exit_code == 1);
    CHECK(contains(wrong.out, "FAIL  " + s.expectation));
  }
}

}  // namespace
}  // namespace tack
