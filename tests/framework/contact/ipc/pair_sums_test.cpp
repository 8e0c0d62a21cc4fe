// Plain sums over close pairs: weights, inclusion-exclusion, searches in parts.
#include "framework/contact/ipc/pair_sums.hpp"

#include <catch2/catch.hpp>
#include <map>

#include "framework/contact/stencils/stencil_kinds.hpp"
#include "geometry/errors.hpp"
#include "tests/support/contact_terms.hpp"
#include "tests/support/scene.hpp"
#include "tests/support/tet_body.hpp"
#include "tests/support/three_boxes.hpp"

using namespace tack;

namespace {

// A fixed ground of n x n cells of 0.1 m / n, and a plate of four equal triangles 1 mm above it.
std::string plate_over_ground(int n, const std::string& model) {
  return "objects:\n"
         "  - {name: ground, shape: {type: grid, size: [0.1, 0.1], cells: [" + std::to_string(n) + ", " + std::to_string(n) + "]}, motion: [fixed]}\n"
         "  - {name: plate, shape: {type: grid, size: [0.02, 0.02], cells: [1, 2]}, place: {translate: [0.0013, 0.001, 0.0017]},\n"
         "     energies: [{type: stvk_membrane, young: 1e5, poisson: 0.3, density: 1000}], shell: {thickness: 1 mm}}\n"
         "contact: {distance: 2 mm, model: " + model + "}\n";
}

// Sums of weights of the stencils of each vertex of the plate, and of edges.
struct Weights {
  explicit Weights(const std::string& yaml) : scene(yaml) {
    World& world = *scene.world;
    world.contact->begin_step({world.rest});
    world.contact->move_to(world.rest);
    const ContactSet& set = world.contact->contacts();
    const std::vector<int>& object = world.contact->surface().mesh.vertex_object;
    const auto add = [&](const auto& stencils) {
      for (const auto& s : stencils)
        if (object[s.vertices[0]] == 1) of_vertex[s.vertices[0]] += s.weight;
    };
    add(set.point_point);
    add(set.point_edge);
    add(set.point_triangle);
    for (const auto& s : set.edge_edge) edges += s.weight;
  }

  TestScene scene;
  std::map<int, double> of_vertex;
  double edges = 0;
};

}  // namespace

TEST_CASE("pair sums: weights of vertices are their areas, a quarter of them, or equal", "[contact][ipc]") {
  for (const int n : {1, 4}) {
    const std::string once = ", inclusion_exclusion: true}";
    const Weights present(plate_over_ground(n, "{type: ipc" + once)), quarter(plate_over_ground(n, "{type: ipc, weights: rest_area" + once)),
        equal(plate_over_ground(n, "{type: ipc, weights: equal" + once));
    REQUIRE(present.of_vertex.size() == 6);
    double sum = 0;
    for (const auto& [v, weight] : present.of_vertex) {
      sum += weight;
      CHECK(quarter.of_vertex.at(v) == Approx(weight / 4));
      CHECK(equal.of_vertex.at(v) == Approx((0.02 * 0.02 / 6 + 0.01 / ((n + 1) * (n + 1))) / 2));
    }
    CHECK(sum == Approx(0.02 * 0.02));
    CHECK(present.edges == quarter.edges);
    CHECK(present.edges > 0);
  }
}

TEST_CASE("pair sums: without inclusion-exclusion a vertex counts every triangle in range", "[contact][ipc]") {
  const Weights once(plate_over_ground(40, "{type: ipc, inclusion_exclusion: true}")), each(plate_over_ground(40, "ipc"));
  double sum_once = 0, sum_each = 0;
  for (const auto& [v, weight] : once.of_vertex) sum_once += weight, sum_each += each.of_vertex.at(v);
  CHECK(sum_once == Approx(0.02 * 0.02));
  CHECK(sum_each > 1.5 * sum_once);
}

TEST_CASE("pair sums: a search in parts finds what a new search finds", "[contact][ipc]") {
  for (const char* model : {"ipc", "{type: ipc, weights: rest_area, inclusion_exclusion: true}", "{type: ipc, weights: equal}"}) {
    TestScene scene(three_boxes(3) + "contact: {distance: 0.012, model: " + model + "}\n"), other(three_boxes(3) + "contact: {distance: 0.012, model: " + model + "}\n");
    RandomMotions random(7);
    ContactSystem &kept = *scene.world->contact, &cleared = *other.world->contact;
    size_t found = 0;
    for (int step = 0; step < 6; ++step) {
      const VecX x = scene.world->rest + 0.004 * random.vectors(scene.world->rest.size()), y = x + 0.004 * random.vectors(x.size());
      kept.begin_step({x});
      cleared.clear_caches();
      cleared.begin_step({x});
      kept.move_to(y);
      cleared.move_to(y);
      CHECK(kept.contacts().size() == cleared.contacts().size());
      CHECK(contact_term(*scene.world).value(y) == contact_term(*other.world).value(y));
      found += kept.contacts().size();
    }
    CHECK(found > 100);
  }
}

TEST_CASE("pair sums: neighbours at rest press, those that share a vertex do not", "[contact][ipc]") {
  TestScene ipc("objects: [{name: a, shape: {type: box, size: [0.1, 0.1, 0.1], cells: [5, 5, 5]}, energies: [{type: neo_hookean, young: 1e5, density: 1000}]}]\n"
                "contact: {distance: 0.03, model: ipc}\n");
  CHECK(ipc.world->contact->surface().rest_gaps == nullptr);
  ipc.world->contact->begin_step({ipc.world->rest});
  ipc.world->contact->move_to(ipc.world->rest);
  CHECK(ipc.world->contact->contacts().size() > 0);
}
