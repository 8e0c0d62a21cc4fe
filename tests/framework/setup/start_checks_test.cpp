// Errors of invalid initial states recommend only remedies that help.
#include <catch2/catch.hpp>

#include "framework/output/state_file.hpp"
#include "geometry/errors.hpp"
#include "tests/support/program.hpp"
#include "tests/support/scene.hpp"

using namespace tack;

namespace {

std::string advice(const std::string& objects, const std::string& contact = "distance: 1 mm") {
  try {
    TestScene scene("contact: {" + contact + "}\nobjects:\n" + objects);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

std::string box(const char* name, double height) {
  return fmt::format("  - {{name: {}, shape: {{type: box, size: [0.1, 0.1, 0.1]}}, place: {{translate: [0, {}, 0]}}, energies: [{{type: neo_hookean, young: 1 MPa}}]}}\n", name, height);
}

}  // namespace

TEST_CASE("objects that overlap may be moved or pushed apart, once", "[setup]") {
  CHECK(contains(advice(box("a", 0) + box("b", 0.09)), "move the objects apart (place.translate), have them pushed apart"));
  CHECK_FALSE(contains(advice(box("a", 0) + box("b", 0.05), "distance: 1 mm, overclosure_adjustment: 1 um"), "have them pushed apart"));
}

TEST_CASE("the remedy for an object that intersects itself is a repair of its mesh", "[setup]") {
  const TemporaryFolder folder;
  const std::string path = folder.path() / "crossing.obj";
  write_file(path, "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0.2 0.2 -0.5\nv 0.3 0.2 0.5\nv 0.2 0.3 0.5\nf 1 2 3\nf 4 5 6\n");
  const std::string told = advice("  - {name: a, shape: {type: file, path: " + path + "}, shell: {thickness: 1 mm}, energies: [{type: neo_hookean_membrane, young: 1 MPa, density: 1000}]}\n");
  CHECK(contains(told, "of 'a' meets triangle"));
  CHECK(contains(told, "tack mesh repair"));
  CHECK_FALSE(contains(told, "move the objects apart"));
}
