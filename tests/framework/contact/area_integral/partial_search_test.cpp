// A search for some objects within a step yields the contacts of a search for all.
#include <catch2/catch.hpp>

#include <random>

#include "framework/contact/contact_system.hpp"
#include "tests/support/scene.hpp"

using namespace tack;

namespace {

// Grains in a pan under a sheet, a block, a rod and a particle. A motion of the fixed box far away
// causes a search of all objects.
const std::string heap =
    "time: {step: 0.01, duration: 1}\n"
    "objects:\n"
    "  - {name: pan, shape: {type: revolve, profile_x: 0.05 * s, profile_y: 0.04 * s^6, cells_profile: 10, cells_around: 24}, motion: [fixed]}\n"
    "  - {name: far, shape: {type: box, size: [0.01, 0.01, 0.01]}, place: {translate: [0, -9, 0]}, motion: [fixed]}\n"
    "  - {name: sheet, shape: {type: grid, size: [0.06, 0.06], cells: [12, 12]}, place: {translate: [0, 0.03, 0]}, shell: {thickness: 0.5 mm}, contact_offset: 0.25 mm,\n"
    "     energies: [{type: neo_hookean_membrane, young: 1e5, density: 1000}]}\n"
    "  - {name: block, shape: {type: box, size: [0.03, 0.01, 0.03], cells: [7, 2, 7]}, place: {translate: [0.008, 0.0365, 0]}, energies: [{type: neo_hookean, young: 1e5}]}\n"
    "  - {name: rod, shape: {type: segment, length: 0.05, edges: 10}, place: {translate: [0, 0.0432, 0]}, rod: {radius: 0.5 mm}, contact_offset: 0.5 mm,\n"
    "     energies: [{type: elastic_rod, young: 1e6, density: 1000}]}\n"
    "  - {name: dust, shape: {type: points}, place: {translate: [0.01, 0.0428, 0.002]}, particle: {radius: 0.4 mm}, contact_offset: 0.4 mm, energies: [{type: particle, mass: 1e-6}]}\n"
    "  - name: grain\n"
    "    shape: {type: revolve, profile_x: 0.004 * sqrt(s * (1 - s)), profile_y: 0.004 * (2 * s - 1), cells_profile: 3, cells_around: 6}\n"
    "    body: {type: affine, density: 1200}\n"
    "    fill: {region: {type: cylinder, radius: 25 mm, height: 24 mm, place: {translate: [0, 17 mm, 0]}}, count: 60, clearance: 0.6 mm}\n"
    "contact:\n"
    "  distance: 1.6 mm\n"
    "  barrier: {stiffness: 10 kPa}\n"
    "  pairs:\n"
    "    - {between: [sheet, grain], adhesion: {type: fang, peak_traction: 20 kPa, range: 2 mm}}\n"
    "    - {between: [sheet, block], adhesion: {type: fang, peak_traction: 20 kPa, range: 2 mm}}\n";

template <class Stencils>
void check_same(const Stencils& found, const Stencils& wanted) {
  const auto rows = [](const Stencils& all) {
    std::vector<std::tuple<int, decltype(all[0].vertices), double>> sorted;
    for (const auto& s : all) sorted.emplace_back(s.law, s.vertices, s.weight);
    std::sort(sorted.begin(), sorted.end());
    return sorted;
  };
  CHECK(rows(found) == rows(wanted));
}

}  // namespace

TEST_CASE("contacts after a search of some objects are those after a search of all") {
  TestScene some(heap), all(heap);
  ContactSystem &partly = *some.world->contact, &wholly = *all.world->contact;
  VecX x = some.world->rest;
  const int far = some.world->bodies[some.world->body_index("far")].first_vertex;
  partly.begin_step({x});
  wholly.begin_step({x});
  std::mt19937 random(5);
  std::uniform_real_distribution<double> component(-1, 1);
  size_t most = 0, samples = 0;
  for (int move = 0; move < 30; ++move) {
    // One to three objects leave their fat AABBs; all others stay inside.
    for (int k = 0; k <= move % 3; ++k) {
      const size_t object = 2 + random() % (some.world->bodies.size() - 2);
      const Vec3 displacement = 1.5e-3 * Vec3(component(random), component(random), component(random));
      const Body& body = some.world->bodies[object];
      for (int v = body.first_vertex; v < body.first_vertex + body.vertex_count; ++v) vertex(x, v) += displacement;
    }
    partly.move_to(x);
    VecX y = x;
    y[3 * far + 1] -= move % 2;
    wholly.move_to(y);
    INFO("move " << move);
    const ContactSet &found = partly.contacts(), &wanted = wholly.contacts();
    most = std::max(most, found.size());
    check_same(found.point_point, wanted.point_point);
    check_same(found.point_edge, wanted.point_edge);
    check_same(found.point_triangle, wanted.point_triangle);
    check_same(found.edge_edge, wanted.edge_edge);
    check_same(found.interior_point, wanted.interior_point);
    check_same(found.interior_edge, wanted.interior_edge);
    check_same(found.interior_triangle, wanted.interior_triangle);
    samples = std::max(samples, found.interior_triangle.size());
  }
  CHECK(most > 500);
  CHECK(samples > 10);
  CHECK(partly.broad_phase_builds() > 20);
}
