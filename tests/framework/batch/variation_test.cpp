#include "framework/batch/variation.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "framework/config/bind.hpp"
#include "framework/config/parse.hpp"
#include "geometry/errors.hpp"

using namespace tack;

namespace {

std::vector<Variant> variants_of(const std::string& yaml) {
  return bind_component<Variation>(parse_string(yaml, "vary.yaml"))->variants();
}

// "a=1 b=x" of the settings.
std::string text_of(const Variant& v) {
  std::string text;
  for (const Variant::Setting& s : v.set) text += (text.empty() ? "" : " ") + s.key + "=" + s.value.text;
  return text;
}

std::vector<std::string> texts_of(const std::string& yaml) {
  std::vector<std::string> texts;
  for (const Variant& v : variants_of(yaml)) texts.push_back(text_of(v));
  return texts;
}

double number_of(const Variant& v, size_t k) { return std::stod(v.set[k].value.text); }

}  // namespace

TEST_CASE("a grid has all combinations, the last key fastest", "[batch]") {
  CHECK(texts_of("{type: grid, keys: {a: [1, 2], b.0.c: [x, 5 mm, z]}}") ==
        std::vector<std::string>{"a=1 b.0.c=x", "a=1 b.0.c=5 mm", "a=1 b.0.c=z", "a=2 b.0.c=x", "a=2 b.0.c=5 mm", "a=2 b.0.c=z"});
  const auto named = variants_of("{type: grid, keys: {long.key: {values: [{type: lbfgs}], as: solver}}}");
  REQUIRE(named.size() == 1);
  CHECK(named[0].shown[0].column == "solver");
  CHECK(named[0].shown[0].text == "{type: lbfgs}");
}

TEST_CASE("a zip takes one of each", "[batch]") {
  CHECK(texts_of("{type: zip, keys: {a: [1, 2], b: [3, 4]}}") == std::vector<std::string>{"a=1 b=3", "a=2 b=4"});
  CHECK_THROWS_WITH(variants_of("{type: zip, keys: {a: [1, 2], b: [3]}}"), Catch::Contains("b has 1 values, a has 2"));
}

TEST_CASE("cases are named sets of keys", "[batch]") {
  const auto cases = variants_of("{type: cases, as: material, cases: [{name: soft, set: {a: 1, b: 2}}, {name: plain}]}");
  REQUIRE(cases.size() == 2);
  CHECK(text_of(cases[0]) == "a=1 b=2");
  CHECK(cases[0].shown.size() == 1);
  CHECK(cases[0].shown[0].column == "material");
  CHECK(cases[0].shown[0].text == "soft");
  CHECK(cases[1].set.empty());
}

TEST_CASE("repeats set seeds", "[batch]") {
  CHECK(texts_of("{type: repeat, count: 3, first: 7, keys: [s, t.seed]}") ==
        std::vector<std::string>{"s=7 t.seed=7", "s=8 t.seed=8", "s=9 t.seed=9"});
  CHECK(texts_of("{type: repeat, count: 2}") == std::vector<std::string>{"", ""});
}

TEST_CASE("a Latin hypercube has one sample in each part of each range", "[batch]") {
  const std::string yaml = "{type: latin_hypercube, samples: 20, seed: 3, keys: {a: {from: 10 kPa, to: 30 kPa}, b: {from: 1e-3, to: 1, scale: log}, "
                           "c: {from: 1, to: 5, whole: true}}}";
  const auto samples = variants_of(yaml);
  REQUIRE(samples.size() == 20);
  std::set<int> parts_of_a, parts_of_b;
  std::map<int, int> counts_of_c;
  for (const Variant& v : samples) {
    CHECK(v.set[0].value.text.ends_with(" kPa"));
    CHECK(v.set[0].value.text.size() <= 11);
    parts_of_a.insert(static_cast<int>(std::floor((number_of(v, 0) - 10) / 1.0)));
    parts_of_b.insert(static_cast<int>(std::floor(std::log10(number_of(v, 1) / 1e-3) / 3 * 20)));
    ++counts_of_c[static_cast<int>(number_of(v, 2))];
    CHECK(number_of(v, 2) == std::round(number_of(v, 2)));
  }
  CHECK(parts_of_a.size() == 20);
  CHECK(*parts_of_a.begin() == 0);
  CHECK(*parts_of_a.rbegin() == 19);
  CHECK(parts_of_b.size() == 20);
  CHECK(counts_of_c == std::map<int, int>{{1, 4}, {2, 4}, {3, 4}, {4, 4}, {5, 4}});
  CHECK(texts_of(yaml) == texts_of(yaml));
  CHECK(texts_of(yaml) != texts_of("{type: latin_hypercube, samples: 20, seed: 4, keys: {a: {from: 10 kPa, to: 30 kPa}, "
                                   "b: {from: 1e-3, to: 1, scale: log}, c: {from: 1, to: 5, whole: true}}}"));
}

TEST_CASE("Sobol's samples fill the square, and more keep the first", "[batch]") {
  const auto yaml = [](int n) {
    return "{type: sobol, samples: " + std::to_string(n) + ", keys: {a: {from: 0, to: 1}, b: {from: 0, to: 1}}}";
  };
  const auto few = texts_of(yaml(16)), many = texts_of(yaml(64));
  CHECK(std::equal(few.begin(), few.end(), many.begin()));
  // The 64 points are a (0, 6, 2)-net: one lies in each of 64 boxes, for any power-of-two width.
  for (int wide = 0; wide <= 6; ++wide) {
    std::set<int> boxes;
    for (const Variant& v : variants_of(yaml(64)))
      boxes.insert(static_cast<int>(number_of(v, 0) * (1 << wide)) * 64 + static_cast<int>(number_of(v, 1) * (64 >> wide)));
    CHECK(boxes.size() == 64);
  }
}

TEST_CASE("wrong variations are refused with their location", "[batch]") {
  const auto refused = [](const std::string& yaml, const std::string& message) {
    CHECK_THROWS_WITH(variants_of(yaml), Catch::Contains("vary.yaml:1:") && Catch::Contains(message));
  };
  refused("{type: grid, keys: {a: 5}}", "a: expects a list of values, got '5'");
  refused("{type: grid, keys: {a: []}}", "expects a list of values");
  refused("{type: grid, keys: [a]}", "expects a map of keys");
  refused("{type: grid, keys: {a: {from: 1, to: 2}}}", "a range is for type: latin_hypercube");
  refused("{type: grid, keys: {a: {value: [1]}}}", "unknown key 'value'; did you mean 'values'?");
  refused("{type: sobol, samples: 4, keys: {a: [1, 2]}}", "expects a range");
  refused("{type: sobol, samples: 4, keys: {a: {from: 2, to: 1}}}", "must be below");
  refused("{type: sobol, samples: 4, keys: {a: {from: 1 kPa, to: 1 MPa}}}", "write both in one unit");
  refused("{type: sobol, samples: 4, keys: {a: {from: 0, to: 1, scale: log}}}", "needs 'from' above zero");
  refused("{type: sobol, samples: 4, keys: {a: {from: x, to: 1}}}", "expects a number");
  refused("{type: sobol, samples: 0, keys: {a: {from: 0, to: 1}}}", "samples");
  refused("{type: cases, cases: []}", "cases");
  refused("{type: cases, cases: [{name: a, set: [1]}]}", "expects a map of keys");
}

TEST_CASE("a range of whole numbers has whole ends", "[batch]") {
  for (const char* range : {"{from: 0.5, to: 3, whole: true}", "{from: 1, to: 2.5, whole: true}"})
    CHECK_THROWS_WITH(variants_of(std::string("{type: sobol, samples: 4, keys: {a: ") + range + "}}"), Catch::Contains("whole: true needs 'from' and 'to' that are whole numbers"));
}
