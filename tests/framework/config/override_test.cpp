#include <catch2/catch.hpp>

#include "framework/config/yaml_text.hpp"
#include "tests/framework/config/toy.hpp"

using namespace tack;
using toy::message_of;

namespace {

const char* const scene =
    "time: {step: 0.1}\n"
    "objects:\n"
    "  - {name: desk, size: 1}\n"
    "  - {name: plate, shape: {size: 2}}\n"
    "linear: cholmod\n"
    "empty:\n";

std::string after(const std::string& assignment) {
  Value v = parse_string(scene, "s.yaml");
  apply_override(v, assignment);
  return inline_text(v);
}

std::string error_after(const std::string& assignment) {
  return message_of([&] { after(assignment); });
}

}  // namespace

TEST_CASE("option --set replaces and creates values at a dotted path") {
  const std::string objects = "[{name: desk, size: 1}, {name: plate, shape: {size: 2}}]";
  const std::string rest = ", linear: cholmod, empty: null";
  CHECK(after("time.step=5 ms") == "{time: {step: \"5 ms\"}, objects: " + objects + rest + "}");
  CHECK(after("time={a: [1, 2]}") == "{time: {a: [1, 2]}, objects: " + objects + rest + "}");
  CHECK(after("a.b=c=d") ==
        "{time: {step: 0.1}, objects: " + objects + rest + ", a: {b: \"c=d\"}}");
  CHECK(after("empty.x=1") ==
        "{time: {step: 0.1}, objects: " + objects + ", linear: cholmod, empty: {x: 1}}");
  CHECK(after("linear.ordering=metis") == "{time: {step: 0.1}, objects: " + objects +
                                              ", linear: {type: cholmod, ordering: metis}, "
                                              "empty: null}");
  CHECK(after("linear=") ==
        "{time: {step: 0.1}, objects: " + objects + ", linear: null, empty: null}");
}

TEST_CASE("option --set finds list entries by number and by name") {
  const std::string rest = "], linear: cholmod, empty: null}";
  CHECK(after("objects.0.name=table") ==
        "{time: {step: 0.1}, objects: [{name: table, size: 1}, {name: plate, shape: {size: 2}}" +
            rest);
  CHECK(
      after("objects.plate.shape.size=[1, 2]") ==
      "{time: {step: 0.1}, objects: [{name: desk, size: 1}, {name: plate, shape: {size: [1, 2]}}" +
          rest);
}

TEST_CASE("errors of --set quote the option") {
  CHECK(error_after("objects.2.name=x") ==
        "--set objects.2.name=x: there is no entry 2; the list has 2, counted from 0");
  CHECK(error_after("objects.plat.size=1") ==
        "--set objects.plat.size=1: no list entry is named 'plat'; did you mean 'plate'? (names: "
        "desk, plate)");
  const std::string form = ": expects key=value or path.to.key=value";
  CHECK(error_after("time.step") == "--set time.step" + form);
  CHECK(error_after("=3") == "--set =3" + form);
  CHECK(error_after("a..b=3") == "--set a..b=3" + form);
  CHECK_THAT(error_after("a=[1"), Catch::StartsWith("--set a=[1:1:"));

  Value v = parse_string("count: 1\n", "s.yaml");
  apply_override(v, "coutn=4");
  apply_override(v, "time.step=3 mm");
  toy::Scene target;
  const std::string message = message_of([&] { bind(v, target, "scene"); });
  CHECK_THAT(message,
             Catch::StartsWith(
                 "--set coutn=4: unknown key 'coutn' in scene; did you mean 'count'? (keys: "));
  CHECK_THAT(message,
             Catch::EndsWith("\n--set time.step=3 mm: step: expects a time (s), got '3 mm', "
                             "which is a length"));
}

TEST_CASE("a value is found where the same path sets it", "[config]") {
  Value root = parse_string("list: [{name: '1', a: 5}, {name: other, a: 6}]\nplain: {b: 7}\n", "test");
  for (const std::string path : {"list.0.a", "list.1.a", "list.other.a", "plain.b"}) {
    INFO(path);
    set_at(root, path, Value::scalar("new " + path));
    REQUIRE(value_at(root, path));
    CHECK(value_at(root, path)->text == "new " + path);
  }
  for (const std::string path : {"list.2.a", "list.none.a", "list.0.b", "plain.b.c", "none"}) CHECK(value_at(root, path) == nullptr);
}
