// Structs that may be written as a single text.
#include <catch2/catch.hpp>

#include "framework/config/bind.hpp"
#include "framework/config/describe.hpp"
#include "framework/config/parse.hpp"
#include "framework/config/yaml_text.hpp"
#include "tests/framework/config/schema_check.hpp"
#include "tests/framework/config/toy.hpp"
#include "tests/support/json.hpp"

using namespace tack;

namespace {

struct Side {
  std::string object;
  std::optional<double> part;
  void fields(Fields& f) {
    f.text("object", object, "who").required();
    f.optional_number("part", part, units::none, "how much of it");
    f.bare("object");
  }
};

struct Sides {
  std::vector<Side> sides;
  void fields(Fields& f) { f.list("sides", sides, "who meets").required(); }
};

Sides sides_of(const std::string& yaml) {
  Sides sides;
  bind(parse_string(yaml, "s.yaml"), sides, "scene");
  return sides;
}

std::string error(const std::string& yaml) {
  return toy::message_of([&] { sides_of(yaml); });
}

}  // namespace

TEST_CASE("a text is short for a map with one key, and is written so") {
  Sides both = sides_of("sides: [a, {object: b, part: 2}, {object: c}]");
  REQUIRE(both.sides.size() == 3);
  CHECK(both.sides[0].object == "a");
  CHECK_FALSE(both.sides[0].part);
  CHECK(both.sides[1].object == "b");
  CHECK(both.sides[1].part == 2);
  CHECK(both.sides[2].object == "c");
  CHECK(inline_text(to_value(fields_of(both))) == "{sides: [a, {object: b, part: 2}, c]}");
  CHECK(error("sides: [[1]]") == "s.yaml:1:9: sides[0] expects a text or a map, got a list of 1");
  CHECK(error("sides: [{part: 2}]").starts_with("s.yaml:1:9: missing key 'object'"));
}

TEST_CASE("the schema takes a text where a text will do") {
  const nlohmann::json schema = parse_json(json_schema(prototype<Sides>(), "sides"));
  const toy::SchemaCheck check(schema);
  for (const char* document : {R"({"sides": ["a", {"object": "b", "part": 2}]})", R"({"sides": []})"}) CHECK(check.accepts(parse_json(document)));
  for (const char* document : {R"({"sides": [["a"]]})", R"({"sides": [{"part": 2}]})", R"({"sides": [{"object": "b", "whole": 2}]})"}) CHECK_FALSE(check.accepts(parse_json(document)));
}
