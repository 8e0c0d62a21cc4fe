#include "framework/config/merge.hpp"

#include <catch2/catch.hpp>

#include "framework/config/parse.hpp"
#include "framework/config/yaml_text.hpp"
#include "geometry/errors.hpp"

using namespace tack;

namespace {

Value merged(const std::string& base, const std::string& over) {
  Value v = parse_string(base, "base.yaml");
  merge(v, parse_string(over, "over.yaml"));
  return v;
}

std::string text(const std::string& base, const std::string& over) { return inline_text(merged(base, over)); }

std::string error(const std::string& base, const std::string& over) {
  try {
    merged(base, over);
    return "";
  } catch (const InputError& e) {
    return e.what();
  }
}

}  // namespace

TEST_CASE("lists of named entries are merged by name, in the order of the base") {
  CHECK(text("objects: [{name: a, x: 1, y: {p: 1}}, {name: b, x: 2}]",
             "objects: [{name: c, x: 3}, {name: a, y: {q: 2}}]") ==
        "{objects: [{name: a, x: 1, y: {p: 1, q: 2}}, {name: b, x: 2}, {name: c, x: 3}]}");
  // A component of another type is another thing.
  CHECK(text("probes: [{name: a, type: gap, x: 1}]", "probes: [{name: a, type: energy}]") ==
        "{probes: [{name: a, type: energy}]}");
}

TEST_CASE("pairs are merged by the two objects that they name, in any order") {
  CHECK(text("pairs: [{between: [a, b], mu: 1}, {between: [a, a], mu: 2}]",
             "pairs: [{between: [b, a], eps: 3}, {between: [b, b], mu: 4}]") ==
        "{pairs: [{between: [b, a], mu: 1, eps: 3}, {between: [a, a], mu: 2}, {between: [b, b], mu: 4}]}");
  // A region differs from the whole object and from another region.
  CHECK(text("pairs: [{between: [a, b], mu: 1}, {between: [{object: a, select: {type: tag, name: t}}, b], mu: 2}]",
             "pairs: [{between: [b, {object: a, select: {type: tag, name: t}}], mu: 3}, {between: [{object: a, select: all}, b], mu: 4}, {between: [{object: b}, a], mu: 5}]") ==
        "{pairs: [{between: [{object: b}, a], mu: 5}, {between: [b, {object: a, select: {type: tag, name: t}}], mu: 3}, {between: [{object: a, select: all}, b], mu: 4}]}");
}

TEST_CASE("lists with entries that have no name are replaced") {
  CHECK(text("l: [{name: a}, {x: 1}]", "l: [{name: a, y: 1}]") == "{l: [{name: a, y: 1}]}");
  CHECK(text("l: [{name: a}]", "l: [{y: 1}]") == "{l: [{y: 1}]}");
  CHECK(text("l: [{name: a}]", "l: []") == "{l: []}");
  CHECK(text("l: [1, 2]", "l: [3]") == "{l: [3]}");
}

TEST_CASE("named entries can be removed and replaced") {
  const std::string base = "l: [{name: a, x: 1}, {name: b, x: 2}]";
  CHECK(text(base, "l: [{name: a, remove: true}]") == "{l: [{name: b, x: 2}]}");
  CHECK(text(base, "l: [{name: b, replace: true, y: 1}]") == "{l: [{name: a, x: 1}, {name: b, y: 1}]}");
  CHECK(text(base, "l: [{name: b, remove: false, y: 1}]") == "{l: [{name: a, x: 1}, {name: b, x: 2, y: 1}]}");
  CHECK(text("l: [{between: [a, b], x: 1}, {between: [a, c]}]", "l: [{between: [b, a], remove: true}]") ==
        "{l: [{between: [a, c]}]}");
}

TEST_CASE("entries that cannot be merged by name are reported with their location") {
  const std::string base = "l: [{name: apple}]";
  CHECK(error(base, "l: [{name: aple, remove: true}]") ==
        "over.yaml:1:5: there is no 'aple' to remove; did you mean 'apple'? (names: apple)");
  CHECK_THAT(error(base, "l: [{name: b, replace: true}]"), Catch::StartsWith("over.yaml:1:5: there is no 'b' to replace"));
  CHECK_THAT(error(base, "l: [{name: b}, {name: b}]"), Catch::StartsWith("over.yaml:1:16: 'b' is given twice"));
  CHECK_THAT(error(base, "l: [{name: apple, remove: yes}]"), Catch::StartsWith("over.yaml:1:27: remove: expects true or false"));
}

TEST_CASE("a file that includes another merges its lists by name") {
  Value v = merged("objects: [{name: a, shape: {type: box, cells: 2}, loads: [{type: f, value: 1}]}]",
                   "objects: [{name: a, shape: {cells: 3}, loads: [{type: g}]}]");
  CHECK(inline_text(v) == "{objects: [{name: a, shape: {type: box, cells: 3}, loads: [{type: g}]}]}");
  CHECK(v.find("objects")->items[0].mark.text() == "over.yaml:1:11");
}
