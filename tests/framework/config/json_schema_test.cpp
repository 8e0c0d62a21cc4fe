#include <catch2/catch.hpp>

#include "framework/config/describe.hpp"
#include "tests/framework/config/schema_check.hpp"
#include "tests/framework/config/toy.hpp"
#include "tests/support/json.hpp"

using namespace tack;
using nlohmann::json;

namespace {

const json& toy_schema() {
  static const json schema = parse_json(json_schema(prototype<toy::Scene>(), "toy"));
  return schema;
}

bool accepts(const std::string& document) {
  return toy::SchemaCheck(toy_schema()).accepts(parse_json(document));
}

}  // namespace

TEST_CASE("the schema describes every field") {
  const json& s = toy_schema();
  CHECK(s["$schema"] == "http://json-schema.org/draft-07/schema#");
  CHECK(s["title"] == "toy");
  CHECK(s["additionalProperties"] == false);
  const json& properties = s["properties"];
  const Fields fields = prototype<toy::Scene>();
  for (const Field& f : fields.all()) {
    INFO(f.key);
    REQUIRE(properties.contains(f.key));
    CHECK_THAT(properties[f.key]["description"].get<std::string>(), Catch::StartsWith(f.doc));
  }
  CHECK(properties["density"]["default"] == 1000.0);
  CHECK(properties["density"]["exclusiveMinimum"] == 0.0);
  CHECK(properties["verbose"]["default"] == false);
  CHECK(properties["cells"]["default"] == json::array({1, 2, 3}));
  CHECK(properties["tags"]["default"] == json::array({"a", "b"}));
  CHECK(properties["form"]["enum"] == json::array({"plain", "squared"}));
  CHECK_FALSE(properties["young"].contains("default"));
}

TEST_CASE("the schema accepts documents that bind") {
  for (const char* document :
       {"{}", R"({"density": 3, "young": "5 MPa", "seed": null, "count": 10})",
        R"({"gravity": [0, 0, "-9.81 m/s^2"], "cells": [1, 2, 3], "title": "x", "young": "1e3"})",
        R"({"angles": [1, "30 deg"], "form": "squared", "time": {"step": 0.1}, "ramp": null})",
        R"({"objects": [{"name": "a", "size": [1, 2, 3]}], "clocks": {"a": {"steps": 3}}})",
        R"({"energy": "toy_spring", "energies": [{"type": "toy_sum", "terms": ["toy_nothing"]}]})",
        R"({"energy": {"type": "toy_solid", "young": 1, "density": "1 g/cm^3"}})",
        R"({"spring": {"rest": 0.5}, "energy": null})", R"({"spring": {"type": "toy_nothing"}})",
        R"({"pull": 3, "later": {"any": ["thing"]}})", R"({"pull": [[0, 0], ["1 s", "3 mm"]]})",
        R"({"include": ["a.yaml"], "mesh": "a.obj"})"}) {
    INFO(document);
    CHECK(accepts(document));
  }
}

TEST_CASE("the schema refuses documents that do not bind") {
  for (const char* document : {R"({"densty": 3})",
                               R"({"density": 0})",
                               R"({"density": "five"})",
                               R"({"density": null})",
                               R"({"count": 11})",
                               R"({"count": 1.5})",
                               R"({"verbose": "yes"})",
                               R"({"gravity": [1, 2]})",
                               R"({"cells": [0, 1, 1]})",
                               R"({"angles": []})",
                               R"({"form": "square"})",
                               R"({"time": {"stp": 1}})",
                               R"({"objects": [{"size": [1, 2, 3]}]})",
                               R"({"objects": [{"name": "a", "size": [1, -2, 3]}]})",
                               R"({"clocks": {"a": {"x": 3}}})",
                               R"({"energy": "toy_solid"})",
                               R"({"energy": {"rest": 1}})",
                               R"({"energy": "toy_sprung"})",
                               R"({"energy": {"type": "toy_solid", "young": 1}})",
                               R"({"spring": {"young": 1}})",
                               R"({"energy": {"type": "toy_spring", "young": 1}})",
                               R"({"pull": []})",
                               R"({"pull": [[0, 0, 0]]})",
                               R"({"young": "5 mm"})", R"({"angles": ["5 s"]})", R"({"pull": [["1 m", 0]]})",
                               R"({"energies": [{"rest": 1}]})", R"({"objects": [{"name": "a", "remove": true}]})",
                               R"({"energies": "toy_spring"})"}) {
    INFO(document);
    CHECK_FALSE(accepts(document));
  }
}

TEST_CASE("the echo of a scene fits the schema's defaults") {
  const json& properties = toy_schema()["properties"];
  for (const auto& [key, schema] : properties.items()) {
    if (!schema.contains("default")) continue;
    INFO(key);
    CHECK(accepts(json{{key, schema["default"]}}.dump()));
  }
}

TEST_CASE("a file that includes another may give parts, of the right kind") {
  for (const char* document :
       {R"({"include": "a", "objects": [{"name": "a", "remove": true}, {"size": [1, 2, 3]}]})",
        R"({"include": "a", "energy": {"type": "toy_solid", "young": 1}})", R"({"include": "a", "energies": [{"rest": 1}]})"}) {
    INFO(document);
    CHECK(accepts(document));
  }
  for (const char* document : {R"({"include": "a", "objects": [{"nam": "a"}]})", R"({"include": "a", "energies": [{"rst": 1}]})",
                               R"({"include": "a", "energies": [{"rest": "1 s"}]})"}) {
    INFO(document);
    CHECK_FALSE(accepts(document));
  }
}

TEST_CASE("a file with a name has required keys, a file to be included has none") {
  const json schema = parse_json(json_schema(prototype<toy::Object>(), "object"));
  const toy::SchemaCheck check(schema);
  CHECK(check.accepts(parse_json(R"({"name": "a"})")));
  CHECK(check.accepts(parse_json(R"({"include": "a.yaml"})")));
  CHECK(check.accepts(parse_json(R"({"size": [1, 2, 3]})")));
}
