#include "framework/contact/area_integral/narrow_phase.hpp"

#include <catch2/catch.hpp>
#include <map>

#include "framework/contact/area_integral/area_integral.hpp"
#include "framework/contact/contact_system.hpp"
#include "framework/contact/stencils/stencil_kinds.hpp"
#include "geometry/broad_phase/broad_phase.hpp"
#include "tests/support/scene.hpp"
#include "tests/support/tet_body.hpp"
#include "tests/support/three_boxes.hpp"

using namespace tack;

namespace {

// Returns all values of a list of contacts, for comparison bit by bit.
std::vector<double> written_out(const ContactSet& set) {
  std::vector<double> all = set.mollifier_threshold;
  for_each_kind(set, [&](auto kind, const auto& stencils, const double*) {
    all.push_back(static_cast<double>(stencils.size()));
    for (const auto& s : stencils) {
      all.insert(all.end(), s.vertices.begin(), s.vertices.end());
      all.insert(all.end(), {static_cast<double>(s.law), s.weight});
      if constexpr (is_interior<decltype(kind)>) all.insert(all.end(), s.inside.begin(), s.inside.end());
    }
  });
  return all;
}

// The boxes of three_boxes above a sheet.
std::string boxes_over_sheet(const std::string& contact) {
  return three_boxes(3) +
         "  - {name: sheet, shape: {type: grid, size: [0.4, 0.4], cells: [6, 6]}, place: {translate: [0.05, -0.055, 0]}, "
         "motion: [fixed]}\n"
         "contact: {distance: 0.012, " + contact +
         "pairs: [{between: [a, b], adhesion: {type: fang, young: 1e3, critical_strain: 0.5}}]}\n";
}

}  // namespace

TEST_CASE("contacts do not depend on the distance bounds of candidates", "[contact]") {
  for (const char* contact : {"weights: area, safety_barrier: 1, ", "weights: area, "}) {
    TestScene scene(boxes_over_sheet(contact));
    const ContactSystem& system = *scene.world->contact;
    RandomMotions random(23);
    BroadPhase broad_phase(system.surface().mesh, system.colliding());
    LaggedSurface lagged(system.surface());
    const IntegrationRules& rules = dynamic_cast<const AreaIntegral&>(system.potential()).rules();
    NarrowPhase culled(system.surface(), system.pairs(), rules, lagged, broad_phase), unbounded(system.surface(), system.pairs(), rules, lagged, broad_phase);
    const double range = system.range(), skin = range;
    size_t contacts = 0, known = 0;
    VecX x = scene.world->rest;
    for (int step = 0; step < 8; ++step) {
      const VecX p = (step % 2 ? 0.02 : 0.001) * random.vectors(x.size());
      for (const double s : {0.0, 0.4, 1.0}) {
        const VecX y = x + s * p;
        const bool updated = broad_phase.update(x, p, range, skin);
        Candidates unknown = broad_phase.candidates();
        for (CandidateLengths* c : {&unknown.distance_bounds, &unknown.reference_distances})
          for (auto* list : {&c->point_triangle, &c->edge_edge, &c->point_edge, &c->point_point})
            for (double& length : *list) known += length >= range, length = 0;
        if (s == 0) lagged.update(x);
        const auto found = [&](NarrowPhase& narrow_phase, const Candidates& candidates) {
          if (updated) narrow_phase.set_candidates(candidates);
          if (s == 0) narrow_phase.begin_step(candidates);
          ContactSet set;
          narrow_phase.find(candidates, y, set);
          contacts += set.size();
          return written_out(set);
        };
        REQUIRE(found(culled, broad_phase.candidates()) == found(unbounded, unknown));
      }
      x = scene.world->rest + 0.002 * random.vectors(x.size());
    }
    CHECK(contacts > 1000);
    CHECK(known > 1000);
  }
}

TEST_CASE("edges of a rod that are close at rest do not count as overlapping", "[contact]") {
  // Edges shorter than the rod is thick: those next but one are 1 mm apart, within its 4 mm.
  TestScene scene("objects: [{name: rod, shape: {type: segment, length: 0.02, edges: 20}, rod: {radius: 2 mm}, contact_offset: 2 mm,\n"
                  "  energies: [{type: elastic_rod, young: 1 MPa, density: 1000}]},\n"
                  "  {name: other, shape: {type: segment, length: 0.02, edges: 20}, place: {translate: [0, 0, 4.3 mm]}, rod: {radius: 2 mm},\n"
                  "  contact_offset: 2 mm, energies: [{type: elastic_rod, young: 1 MPa, density: 1000}]}]\n"
                  "contact: {distance: 0.5 mm}\n");
  ContactSystem& contact = *scene.world->contact;
  contact.move_to(scene.world->rest);
  CHECK(contact.smallest_gaps(scene.world->rest).of_all == Approx(0.3e-3));
  CHECK(contact.smallest_gaps(scene.world->rest).between_objects == Approx(0.3e-3));
}

TEST_CASE("the smallest gap of different objects leaves out gaps within one object", "[contact]") {
  // A plate of 0.4 mm is closer to itself than to the floor.
  TestScene scene("objects:\n  - {name: floor, shape: {type: box, size: [0.1, 0.01, 0.1]}, place: {translate: [0, -6 mm, 0]}, motion: [fixed]}\n"
                  "  - {name: plate, shape: {type: box, size: [20 mm, 0.4 mm, 20 mm], cells: [10, 1, 10]}, energies: [{type: neo_hookean, young: 1 MPa}]}\n"
                  "contact: {distance: 1.5 mm}\n");
  ContactSystem& contact = *scene.world->contact;
  VecX x = scene.world->rest;
  contact.move_to(x);
  CHECK(contact.smallest_gaps(x).of_all < 0.4001e-3);
  CHECK(contact.smallest_gaps(x).between_objects == Approx(0.8e-3));
  for (int v = 0; v < x.size() / 3; ++v)
    if (scene.world->body_of(v) == 1) x(3 * v + 1) += 0.05;
  contact.move_to(x);
  CHECK(contact.smallest_gaps(x).of_all < 0.4001e-3);
  CHECK(std::isinf(contact.smallest_gaps(x).between_objects));
}

// A mat of fine edges over a floor of two triangles.
TEST_CASE("pairs of edges that do not adhere have an area limited by the smaller edge, however coarse the other is", "[contact]") {
  const auto [contact_keys, area_ratio_max] = GENERATE(table<std::string, double>(
      {{"", 16}, {", weights: pair", 1e99}, {", pairs: [{between: [floor, mat], adhesion: {type: fang, peak_traction: 1 kPa}}]", 1e99}, {", pairs: [{between: [mat, mat], adhesion: {type: fang, peak_traction: 1 kPa}}]", 16}}));
  CAPTURE(contact_keys);
  TestScene scene("objects:\n  - {name: floor, shape: {type: box, size: [4, 0.5, 4]}, place: {translate: [0, -0.2505, 0]}, motion: [fixed]}\n"
                  "  - {name: mat, shape: {type: box, size: [0.3, 0.02, 0.3], cells: [8, 1, 8]}, place: {translate: [0, 0.01, 0]},\n"
                  "    energies: [{type: neo_hookean, young: 10 kPa}]}\n"
                  "contact: {distance: 2 mm, safety_barrier: 1" + contact_keys + "}\n");
  ContactSystem& contact = *scene.world->contact;
  contact.move_to(scene.world->rest);
  const ContactSurface& surface = contact.surface();
  std::map<std::array<int, 2>, double> areas;
  for (size_t e = 0; e < surface.mesh.edges.size(); ++e) areas[surface.mesh.edges[e]] = surface.edge_area[e];
  int coarse = 0;
  for (const auto& s : contact.contacts().edge_edge) {
    const double a = areas.at({s.vertices[0], s.vertices[1]}), b = areas.at({s.vertices[2], s.vertices[3]});
    const double least = std::min(a, b), most = std::max(a, b);
    coarse += most > 16 * least;
    CHECK(s.weight == Approx(0.25 * (least + std::min(most, area_ratio_max * least))));
    CHECK(s.weight > 0);
  }
  CHECK(coarse > 10);
}
