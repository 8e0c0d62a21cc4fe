// Elements of objects: divided if they are composite, and refused if they have no meaning.
#include "framework/body/elements.hpp"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "framework/config/field.hpp"
#include "framework/scene/energy.hpp"
#include "geometry/errors.hpp"
#include "geometry/tets/divide_tets.hpp"
#include "tests/support/scene.hpp"
#include "tests/support/test_run.hpp"

using namespace tack;
using Catch::Contains;

namespace {

std::string object(const std::string& elements, const std::string& more = "", const std::string& shape = "{type: box, size: [2, 1, 1], cells: [2, 1, 1]}",
                   const std::string& energies = "[{type: neo_hookean, young: 1e5, density: 1000}]") {
  return fmt::format("  - name: bar\n    shape: {}\n    elements: {}\n    energies: {}\n{}", shape, elements, energies, more);
}

std::string objects(const std::string& all) { return "objects:\n" + all; }

// Fills volumes, and knows linear tets alone.
class Unsplit : public Energy {
 public:
  std::unique_ptr<Term> make_term(const Body&, const VecX&) const override { throw InputError("of no body"); }
  std::optional<double> poisson() const override { return 0.3; }
};
TACK_REGISTER(Energy, Unsplit, "unsplit", "What elements are refused for.", "tests");

}  // namespace

TEST_CASE("elements: composite tets are divided into eight, with their masses and surfaces", "[elements]") {
  TestScene s(objects(object("composite")));
  const Body& body = s.world->bodies[0];
  CHECK(body.tets.size() == 8 * 12);
  CHECK(body.vertex_count == 5 * 3 * 3);
  CHECK(body.triangles.size() == 4 * 20);
  CHECK(s.world->tets.size() == body.tets.size());  // tets that must not invert
  CHECK(s.world->mass.sum() == Approx(2000));
  CHECK(s.world->mass.minCoeff() > 0);
  REQUIRE(s.world->elastic_terms.size() == 1);
  const StencilBatch batch = s.world->elastic_terms[0]->batches()[0];
  CHECK(batch.arity == 10);
  CHECK(batch.count == 12);
}

TEST_CASE("elements: patches of a box are its cells, and no vertex is added", "[elements]") {
  TestScene s(objects(object("patches")));
  CHECK(s.world->bodies[0].vertex_count == 12);
  const auto batches = s.world->elastic_terms[0]->batches();
  REQUIRE(batches.size() == 2);
  CHECK(batches[0].arity == 4);
  CHECK(batches[0].count == 12);
  CHECK(batches[1].arity == 8);
  CHECK(batches[1].count == 2);
  CHECK(batches[1].rank_one);
}

TEST_CASE("elements: energies with a selection act on complete composite tets", "[elements]") {
  const std::string energies = "[{type: neo_hookean, young: 1e5, density: 1000, select: {type: box, min: [-2, -2, -2], max: [0.1, 2, 2]}},\n"
                               "     {type: stvk_hencky, young: 3e5, density: 500, select: {type: box, min: [-0.1, -2, -2], max: [2, 2, 2]}}]";
  TestScene s(objects(object("composite", "", "{type: box, size: [2, 1, 1], cells: [2, 1, 1]}", energies)));
  REQUIRE(s.world->elastic_terms.size() == 2);
  for (const auto& term : s.world->elastic_terms) CHECK(term->batches()[0].count == 6);
  CHECK(s.world->mass.sum() == Approx(1500));
  // A selection that contains no complete composite tet selects none.
  CHECK_THROWS_WITH(TestScene(objects(object("composite", "", "{type: box, size: [2, 1, 1], cells: [2, 1, 1]}",
                                             "[{type: neo_hookean, young: 1e5, select: {type: box, min: [-2, -2, -2], max: [-0.4, 2, 2]}}]"))),
                    Contains("no complete element"));
}

TEST_CASE("elements: objects without tets, affine bodies and energies for linear tets only are refused", "[elements]") {
  CHECK_THROWS_WITH(TestScene(objects("  - {name: cloth, shape: {type: grid, size: [1, 1]}, shell: {thickness: 1 mm}, elements: composite,\n"
                                      "     energies: [{type: stvk_membrane, young: 1e5}]}\n")),
                    Contains("test.yaml:") && Contains("'cloth' has no tets") && Contains("take `elements` away"));
  CHECK_THROWS_WITH(TestScene(objects("  - {name: stone, shape: {type: box, size: [1, 1, 1]}, elements: patches, body: affine}\n")),
                    Contains("'stone' is an affine body"));
  for (const std::string elements : {"composite", "patches"})
    CHECK_THROWS_WITH(TestScene(objects(object(elements, "", "{type: box, size: [1, 1, 1]}", "[unsplit]"))),
                      Contains("test.yaml:") && Contains("the energy unsplit knows linear tets only"));
  CHECK_THROWS_WITH(TestScene(objects(object("quadratic"))), Contains("composite") && Contains("patches"));
}

TEST_CASE("elements: sheets and rods on divided tets are divided too", "[elements]") {
  TestScene s(objects("  - name: it\n    elements: composite\n    shell: {thickness: 1 mm}\n"
                      "    shape: {type: parts, parts: [{shape: {type: box, size: [1, 1, 1]}}, {shape: {type: grid, size: [1, 1]}, place: {translate: [0, 2, 0]}}]}\n"
                      "    energies: [{type: neo_hookean, young: 1e5}, {type: stvk_membrane, young: 1e5}]\n"));
  CHECK(s.world->bodies[0].sheet.size() == 8);
}

TEST_CASE("elements: damped, attached, hung and in contact, composite tets come to rest with the forces of linear ones", "[elements]") {
  for (const std::string elements : {"composite", "patches"}) {
    INFO(elements);
    TestRun run("time: {step: 0.02 s, duration: 4 s}\ngravity: [0, -10, 0]\nsolver: {type: projected_newton, tolerance: 1e-4}\n" +
                objects(object(elements,
                               "    damping: {mass: 2, stiffness: 2e-3}\n"
                               "    motion: [{type: fixed, select: {type: face, direction: [-1, 0, 0]}}]\n",
                               "{type: box, size: [2, 1, 1], cells: [2, 2, 2]}", "[{type: neo_hookean, young: 2e7, poisson: 0.45, density: 1000}]") +
                        "  - {name: cap, shape: {type: box, size: [0.2, 0.5, 0.5]}, place: {translate: [1.1, 0, 0]},\n"
                        "     energies: [{type: stvk_hencky, young: 1e6, density: 1000}], attach: [{to: bar, select: {type: face, direction: [-1, 0, 0]}}]}\n"
                        "  - {name: load, shape: {type: box, size: [0.5, 0.5, 0.5], cells: [2, 2, 2]}, place: {translate: [0.3, 0.755, 0]}, elements: " +
                        elements + ",\n     energies: [{type: fixed_corotated, young: 1e6, density: 1000}]}\n" +
                        "contact: {distance: 1 cm, friction: {mu: 0.5}}\n"
                        "probes: [{name: carried, type: reaction, object: bar, direction: [0, 1, 0], select: {type: face, direction: [-1, 0, 0]}},\n"
                        "         {name: pressed, type: contact_force, on: load, from: bar, direction: [0, 1, 0]}]\n"));
    while (run.state().time < 3.99) run.step();
    CHECK(run.sample(0)[0] == Approx(10 * (2000 + 50 + 125)).epsilon(0.01));
    CHECK(run.sample(1)[0] == Approx(10 * 125).epsilon(0.01));
  }
}
