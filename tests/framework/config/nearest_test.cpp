#include "framework/config/nearest.hpp"

#include <catch2/catch.hpp>

#include "framework/config/words.hpp"

using namespace tack;

TEST_CASE("edit distance counts single edits") {
  CHECK(edit_distance("young", "young") == 0);
  CHECK(edit_distance("yong", "young") == 1);
  CHECK(edit_distance("yuong", "young") == 1);
  CHECK(edit_distance("", "abc") == 3);
  CHECK(edit_distance("kitten", "sitting") == 3);
}

TEST_CASE("the nearest name is found, or none") {
  const std::vector<std::string> names{"density", "poisson", "young"};
  CHECK(nearest("yong", names) == "young");
  CHECK(nearest("possion", names) == "poisson");
  CHECK(nearest("thickness", names) == "");
  CHECK(nearest("hookean", {"arap", "stable_neo_hookean"}) == "stable_neo_hookean");
  CHECK(nearest("x", names) == "");
  CHECK(nearest("fbx", {"obj"}) == "");  // two of three letters differ
  CHECK(nearest("ob", {"obj"}) == "obj");
  CHECK(nearest("ab", {"cd"}) == "");
  CHECK(suggestion("yong", names, "keys") ==
        "; did you mean 'young'? (keys: density, poisson, young)");
  CHECK(suggestion("q", {"a"}, "keys") == " (keys: a)");
  // Names of these keys in other programs and papers.
  CHECK(suggestion("dt", {"duration", "step"}, "keys") == "; did you mean 'step'? (keys: duration, step)");
  CHECK(suggestion("E", {"density", "young"}, "keys") == "; did you mean 'young'? (keys: density, young)");
  CHECK(suggestion("nu", {"mu", "poisson"}, "keys") == "; did you mean 'poisson'? (keys: mu, poisson)");
  CHECK(suggestion("dhat", {"distance", "that"}, "keys") == "; did you mean 'distance'? (keys: distance, that)");
  CHECK(suggestion("poissons_ratio", {"poisson"}, "keys") == "; did you mean 'poisson'? (keys: poisson)");
  CHECK(suggestion("dt", {"at"}, "keys") == "; did you mean 'at'? (keys: at)");
  CHECK(suggestion("q", {}, "keys") == "; there are no keys");
}

TEST_CASE("nouns get their article and plural") {
  CHECK(with_article("angle (rad)") == "an angle (rad)");
  CHECK(with_article("pressure (Pa)") == "a pressure (Pa)");
  CHECK(plural("density") == "densities");
  CHECK(plural("work of adhesion") == "works of adhesion");
  CHECK(plural("mass") == "masses");
  CHECK(plural("mass per area") == "masses per area");
  CHECK(plural("file path") == "file paths");
}
