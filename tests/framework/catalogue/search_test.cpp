// Words of the field lead to components, keys, commands and pages that exist; a search finds names, descriptions and headings.
#include <algorithm>
#include <catch2/catch.hpp>
#include <regex>
#include <set>

#include "framework/catalogue/search.hpp"
#include "framework/catalogue/trade_words.hpp"
#include "framework/config/describe.hpp"
#include "framework/experiment/experiment.hpp"
#include "tests/support/program.hpp"

namespace tack {
namespace {

std::vector<std::string> items(std::string_view list) {
  std::vector<std::string> found;
  const std::string text(list);
  const std::regex item("[^,]+");
  for (std::sregex_iterator i(text.begin(), text.end(), item), end; i != end; ++i) found.push_back(std::regex_replace(i->str(), std::regex("^ +"), ""));
  return found;
}

void collect_keys(const Fields& fields, const std::string& prefix, std::set<std::string>& keys) {
  for (const Field& field : fields.all()) {
    keys.insert(prefix + field.key);
    if (const Shape* inner = nested_object(field.shape)) collect_keys(inner->prototype(), prefix + field.key + (field.shape.form == Shape::Form::object ? "." : "[]."), keys);
  }
}

// Kinds, components as "KIND NAME", keys of scenes and commands as "tack NAME".
std::set<std::string> everything() {
  std::set<std::string> names;
  for (const Kind* kind : registered_kinds()) {
    names.insert(kind->name());
    for (const std::string& name : kind->names()) names.insert(kind->name() + " " + name);
  }
  collect_keys(prototype<Experiment>(), "", names);
  const TemporaryFolder folder;
  const std::string help = run_tack(folder.path(), {"--help"}).out;
  const std::regex command("\n  ([a-z]+) ");
  for (std::sregex_iterator i(help.begin(), help.end(), command), end; i != end; ++i) names.insert("tack " + (*i)[1].str());
  return names;
}

std::string search(const std::string& query) {
  const Fields scene = prototype<Experiment>();
  return search_text(query, {&scene, scene_templates(TACK_SOURCE_DIR "/experiments/templates"), page_headings(TACK_SOURCE_DIR "/docs")});
}

TEST_CASE("words of the field lead to what exists", "[catalogue]") {
  const std::set<std::string> names = everything();
  REQUIRE(names.contains("tack mesh"));
  REQUIRE(names.contains("contact.pairs[].friction.mu"));
  std::set<std::string> pages, terms;
  for (const PageHeading& heading : page_headings(TACK_SOURCE_DIR "/docs")) {
    pages.insert(heading.page);
    pages.insert(heading.page.substr(0, heading.page.find('#')));
  }
  for (const TradeWord& entry : trade_words()) {
    INFO(entry.words);
    for (const std::string& term : items(entry.words)) {
      INFO(term);
      CHECK_FALSE(term.empty());
      CHECK(contains(search(term), std::string(entry.words)));
    }
    for (const std::string& name : items(entry.see)) {
      INFO(name);
      CHECK(names.contains(name));
    }
    CHECK(!std::string(entry.about).empty());
    CHECK(pages.contains(std::string(entry.page)));
  }
}

TEST_CASE("a search finds the words that users of other programs have", "[catalogue]") {
  for (const auto& [word, leads_to] : std::vector<std::pair<std::string, std::string>>{{"cohesive zone", "adhesion bilinear"},
                                                                                      {"Traction-Separation", "docs/theory/adhesion_laws.md"},
                                                                                      {"boundary conditions", "motion fixed"},
                                                                                      {"DIRICHLET", "motion translate"},
                                                                                      {"neumann", "load traction"},
                                                                                      {"sensitivity", "output.gradients"},
                                                                                      {"parameter estimation", "tack calibrate"},
                                                                                      {"inverse", "tack calibrate"},
                                                                                      {"mesh import", "shape file"},
                                                                                      {"penalty", "contact.barrier"},
                                                                                      {"augmented Lagrangian", "stepper incremental_potential"},
                                                                                      {"hyperelastic", "energy ogden"},
                                                                                      {"Prony", "energy maxwell"},
                                                                                      {"PSA", "adhesion viscoelastic"},
                                                                                      {"tack test", "tack new"},
                                                                                      {"JKR", "docs/measured.md#from-jkr-to-dmt"},
                                                                                      {"mortar", "contact_model clipped"},
                                                                                      {"CCD", "step_filter ccd"},
                                                                                      {"rayleigh damping", "objects[].damping.mass"},
                                                                                      {"SDF", "shape level_set"},
                                                                                      {"von mises stress", "von_mises_stress"},  // a field of frames
                                                                                      {"joint angle", "probe joint_angle"},
                                                                                      {"peak_traction", "adhesion fang"},        // a key of components
                                                                                      {"mu static", "contact.pairs[].friction.mu_static"},
                                                                                      {"fluid cavities", "docs/theory/joints_and_loads.md#fluid-cavities"}}) {
    INFO(word);
    CHECK(contains(search(word), leads_to));
  }
  CHECK(search("xyzzy").empty());
  CHECK(search("").empty());
  CHECK_FALSE(contains(search("ccd"), "accd"));  // words begin, they are not parts of others
  CHECK(contains(nearest_findable("neo_hokean"), "'neo_hookean'"));
  CHECK(contains(nearest_findable("dirichlt"), "'dirichlet'"));
}

TEST_CASE("headings have the anchors of the site", "[catalogue]") {
  CHECK(anchor_of("Units, includes and paths") == "units-includes-and-paths");
  CHECK(anchor_of("Columns of `steps.csv`") == "columns-of-stepscsv");
  CHECK(page_headings("no/such/folder").empty());
}

TEST_CASE("tack list searches words that are no kind", "[catalogue]") {
  const TemporaryFolder folder;
  const auto list = [&](const Arguments& words) { return run_tack(folder.path(), words); };
  const ProgramResult found = list({"list", "cohesive zone"});
  CHECK(found.exit_code == 0);
  CHECK(contains(found.out, "docs/theory/bonds.md#cohesive-laws"));
  CHECK(list({"list", "cohesive", "zone"}).out == found.out);
  CHECK(contains(list({"list", "scene"}).out, "docs/scenes.md"));  // pages are found beside the program
  CHECK(list({"list", "xyzzy"}).exit_code == 2);
  for (const char* word : {"uv", "timestep", "pin", "transparent", "shadow", "mp4", "softbody", "velcro", "framerate", "hdri", "fbx"}) {
    INFO(word);
    CHECK(contains(list({"list", word}).out, "  read  docs/"));
  }
  CHECK(contains(list({"list", "soft", "body"}).out, "neo_hookean"));
  CHECK(contains(list({"list", "purple", "xyzzy"}).err, "nothing is found for 'purple xyzzy'"));
  CHECK(contains(list({"list", "enrgy", "fang"}).err, "unknown kind 'enrgy'; did you mean 'energy'?"));
}

}  // namespace
}  // namespace tack
