#include "framework/config/retired_keys.hpp"

#include <catch2/catch.hpp>
#include <map>
#include <set>

#include "framework/config/describe.hpp"
#include "framework/config/parse.hpp"
#include "framework/config/yaml_text.hpp"
#include "framework/experiment/load_experiment.hpp"
#include "framework/experiment/retired_key_warnings.hpp"
#include "geometry/errors.hpp"
#include "tests/framework/config/schema_check.hpp"
#include "tests/support/json.hpp"
#include "tests/support/program.hpp"
#include "tests/support/tiny_scene.hpp"
#include "tests/support/warnings.hpp"

using namespace tack;
using Catch::Contains;

namespace {

// A use of a key: the map that holds it, as YAML in braces up to the key, the value and the rest.
struct Use {
  std::string before, value, after;
  std::string path;  // of the key
};

const std::map<std::string, Use> uses = {
    {"between_prescribed", {"contact: {", "false", "}", "contact.between_prescribed"}},
    {"safety_barrier", {"contact: {", "0.25", "}", "contact.safety_barrier"}},
    {"overclosure_adjustment", {"contact: {", "2 mm", "}", "contact.overclosure_adjustment"}},
    {"max_cutbacks", {"time: {", "3", "}", "time.max_cutbacks"}},
    {"position_motor",
     {"interactions: [{type: slider, name: rail, object: a, axis: [1, 0, 0], at: [0, 0, 0], ",
      "{way: 0.1, force: 1}", "}]", "interactions.rail.position_motor"}},
    {"content",
     {"interactions: [{type: chamber, name: air, parts: [{object: a}], ", "{type: gas, leak: 2}",
      "}]", "interactions.air.content"}},
};

const std::string head =
    "name: s\nobjects: [{name: a, shape: {type: box, size: [1, 1, 1]}, motion: [fixed]}]\n";

// The key is in line 3.
std::string scene_with(const Use& use, const std::string& key) {
  return head + use.before + key + ": " + use.value + use.after + "\n";
}

std::string scene_without(const Use& use) {
  return head + use.before.substr(0, use.before.find_last_not_of(", ") + 1) + use.after + "\n";
}

std::string resolved(const LoadedExperiment& loaded) { return to_yaml(fields_of(loaded.experiment)); }

std::vector<Warning> warnings_of(const LoadedExperiment& loaded) {
  return retired_key_warnings(loaded.root, loaded.experiment);
}

const nlohmann::json& scene_schema() {
  static const nlohmann::json schema = parse_json(json_schema(prototype<Experiment>(), "scene"));
  return schema;
}

// Returns all keys of these fields, of the objects in them and of all components.
std::set<std::string> keys_of_scenes() {
  std::set<std::string> keys;
  const std::function<void(const Fields&)> add = [&](const Fields& fields) {
    for (const Field& f : fields.all()) {
      keys.insert(f.key);
      if (const Shape* inner = nested_object(f.shape)) add(inner->prototype());
    }
  };
  add(prototype<Experiment>());
  for (const Kind* kind : registered_kinds())
    for (const std::string& name : kind->names()) add(kind->prototype(name));
  return keys;
}

}  // namespace

TEST_CASE("no key of a scene has a retired name, and every retired key has a present name") {
  const std::set<std::string> keys = keys_of_scenes();
  for (const RetiredKey& k : retired_keys()) {
    INFO(k.retired);
    CHECK_FALSE(keys.contains(std::string(k.retired)));
    CHECK(keys.contains(std::string(k.present)));
    CHECK(present_key(k.retired) == k.present);
    CHECK(present_key(k.present) == k.present);
    CHECK(uses.contains(std::string(k.present)));
  }
}

TEST_CASE("a retired key gives the scene of the present key, with a warning") {
  for (const RetiredKey& k : retired_keys()) {
    INFO(k.retired);
    const Use& use = uses.at(std::string(k.present));
    const LoadedExperiment present = parse_experiment(scene_with(use, std::string(k.present)), "s.yaml");
    const LoadedExperiment retired = parse_experiment(scene_with(use, std::string(k.retired)), "s.yaml");
    CHECK(resolved(retired) == resolved(present));
    if (k.present != "content")  // a required key
      CHECK(resolved(retired) != resolved(parse_experiment(scene_without(use), "s.yaml")));
    CHECK(warnings_of(present).empty());
    const std::string location = "s.yaml:3:" + std::to_string(use.before.size() + 1);
    CHECK(only_text(warnings_of(retired), WarningKind::retired_key) ==
          location + ": '" + std::string(k.retired) + "' is now called '" + std::string(k.present) + "'");
  }
}

TEST_CASE("a retired key beside its present key is refused, with both locations") {
  for (const RetiredKey& k : retired_keys()) {
    const Use& use = uses.at(std::string(k.present));
    const std::string retired(k.retired), present(k.present);
    for (const bool first : {true, false}) {
      const std::string twice = first ? present + ": " + use.value + ", " + retired : retired + ": " + use.value + ", " + present;
      INFO(twice);
      const size_t here = use.before.size() + 1, there = here + (first ? present : retired).size() + use.value.size() + 4;
      const std::string at_retired = "s.yaml:3:" + std::to_string(first ? there : here), at_present = "s.yaml:3:" + std::to_string(first ? here : there);
      CHECK_THROWS_WITH(parse_experiment(scene_with(use, twice), "s.yaml"),
                        at_retired + ": '" + retired + "' is now called '" + present + "', and " + at_present + " has that key as well; keep one of them");
    }
  }
}

TEST_CASE("a path finds and overrides a key by either name") {
  for (const RetiredKey& k : retired_keys()) {
    INFO(k.retired);
    const Use& use = uses.at(std::string(k.present));
    const std::string retired(k.retired), present(k.present);
    const std::string stem = use.path.substr(0, use.path.size() - present.size());
    const LoadedExperiment expected = parse_experiment(scene_with(use, present), "s.yaml");
    const Value tree = to_value(fields_of(expected.experiment));
    REQUIRE(value_at(tree, stem + retired));
    CHECK(value_at(tree, stem + retired) == value_at(tree, stem + present));
    for (const std::string& in_file : {retired, present})
      for (const std::string& in_path : {retired, present}) {
        INFO(in_file << " " << in_path);
        Use other = use;
        other.value = "null";
        const LoadedExperiment loaded = parse_experiment(scene_with(other, in_file), "s.yaml", {stem + in_path + "=" + use.value});
        CHECK(resolved(loaded) == resolved(expected));
        CHECK(warnings_of(loaded).size() == (in_path == retired ? 1 : 0));
      }
  }
}

TEST_CASE("a file overrides a key of an included file by either name") {
  for (const RetiredKey& k : retired_keys())
    for (const auto& [below, above] : {std::pair{k.retired, k.present}, {k.present, k.retired}}) {
      INFO(below << " " << above);
      Value base = Value::map(), over = Value::map();
      base.set("first", Value::scalar("1"));
      base.set(std::string(below), Value::scalar("2"));
      over.set(std::string(above), Value::scalar("3"));
      Value merged = base;
      merge(merged, over);
      CHECK(inline_text(merged) == "{first: 1, " + std::string(above) + ": 3}");
      // Both names in one file stay, for the error.
      over.set(std::string(below), Value::scalar("4"));
      for (Value under : {base, Value::map()}) {
        merge(under, over);
        CHECK(under.find(below));
        CHECK(under.find(above));
      }
    }
}

TEST_CASE("schema and reference list retired keys as deprecated") {
  const std::string page = reference_page(prototype<Experiment>(), "Scenes");
  for (const RetiredKey& k : retired_keys()) {
    INFO(k.retired);
    CHECK_THAT(page, Contains("Deprecated name: `" + std::string(k.retired) + "`"));
    CHECK_THAT(scene_schema().dump(), Contains("Deprecated: now called '" + std::string(k.present) + "'."));
  }
  const auto accepts = [](const std::string& more) {
    return toy::SchemaCheck(scene_schema())
        .accepts(parse_json(R"({"name": "s", "objects": [{"name": "a", "shape": {"type": "box", "size": [1, 1, 1]}}], )" + more + "}"));
  };
  CHECK(accepts(R"("time": {"max_cutbacks": 3})"));
  CHECK(accepts(R"("time": {"max_halvings": 3})"));
  CHECK_FALSE(accepts(R"("time": {"max_halvings": -3})"));
  const std::string chamber = R"("interactions": [{"type": "chamber", "parts": [{"object": "a"}])";
  CHECK(accepts(chamber + R"(, "content": "gas"}])"));
  CHECK(accepts(chamber + R"(, "filling": "gas"}])"));
  CHECK_FALSE(accepts(chamber + "}]"));
}

TEST_CASE("check and run warn of a retired key, and the resolved scene has the present key") {
  const TemporaryFolder folder;
  std::string scene = tiny_scene;
  scene.replace(scene.find("duration: 0.05 s"), 16, "duration: 0.01 s, max_halvings: 5");
  write_file(folder.path() / "scene.yaml", scene);
  const std::string warning = "warning: scene.yaml:2:40: 'max_halvings' is now called 'max_cutbacks'";
  CHECK_THAT(run_tack(folder.path(), {"check", "scene.yaml"}).out, Contains(warning));
  const ProgramResult run = run_tack(folder.path(), {"run", "scene.yaml"});
  CHECK_THAT(run.out, Contains(warning));
  const std::string kept = file_text(folder.path() / "results" / "tiny" / "scene.yaml");
  CHECK_THAT(kept, Contains("max_cutbacks: 5") && !Contains("max_halvings"));
}
