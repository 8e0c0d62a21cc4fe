// Contact points of all contact models: stencils name their contact point, and contact is asked for
// at the configuration at which it is.
#include <catch2/catch.hpp>

#include <map>
#include <stdexcept>
#include <tuple>

#include "framework/contact/contact_model.hpp"
#include "framework/contact/points/contact_points.hpp"
#include "framework/contact/contact_potential.hpp"
#include "framework/contact/terms/friction_term.hpp"
#include "framework/contact/stencils/stencil_kinds.hpp"
#include "framework/output/vertex_gaps.hpp"
#include "framework/output/vertex_tractions.hpp"
#include "tests/support/scene.hpp"

using namespace tack;
using Catch::Contains;

namespace {

// A box that is turned over another and over a plate, so that points have several features.
std::string boxes(const std::string& model) {
  return "objects:\n"
         "  - {name: a, shape: {type: box, size: [0.1, 0.1, 0.1], cells: [3, 3, 3]}, motion: [fixed]}\n"
         "  - {name: b, shape: {type: box, size: [0.1, 0.1, 0.1], cells: [2, 2, 2]}, place: {axis: [1, 0, 0], angle: 0.02 rad, translate: [0.05, 0.102, 0.02]}, energies: [{type: neo_hookean, young: 1e5, density: 1000}]}\n"
         "  - {name: c, shape: {type: box, size: [0.1, 0.1, 0.1], cells: [4, 4, 4]}, place: {translate: [0.102, 0, 0.01]}, motion: [fixed]}\n"
         "contact: {distance: 5 mm, friction: {mu: 0.5}, model: " + model + "}\n";
}

// As written out, bit by bit.
std::vector<double> written(const ContactPoints& points) {
  std::vector<double> all;
  for_each_record(points, [&](const auto& c) {
    all.insert(all.end(), c.vertices.begin(), c.vertices.end());
    all.insert(all.end(), {c.gap, c.area, c.normal_force, double(c.law)});
  });
  return all;
}

VecX pressures(const World& world, const VecX& x) {
  VecX forces = VecX::Zero(x.size());
  for (const ForceRecord& force : world.records.forces())
    if (force.direction == ForceDirection::normal) force.add(x, "", forces);
  return normal_pressures(world, x, forces, "");
}

}  // namespace

TEST_CASE("contact points: the stencils of one have its vertex, object and law, and points ascend by these", "[contact][contact_model]") {
  for (const std::string& model : Registry<ContactModel>::kind().names()) {
    INFO(model);
    TestScene scene(boxes(model));
    ContactSystem& contact = *scene.world->contact;
    contact.begin_step({scene.world->rest});
    contact.move_to(scene.world->rest);
    const ContactSet& set = contact.contacts();
    using Key = std::tuple<int, int, int>;  // vertex, object, law
    std::map<int, Key> keys;
    int count = 0;
    for_each_kind(set, [&](auto kind, const auto& stencils, const double*) {
      using Kind = decltype(kind);
      if constexpr (!is_interior<Kind> && !std::is_same_v<Kind, EdgeEdgeKind>)
        for (const auto& s : stencils) {
          if (s.point < 0) continue;
          CHECK(s.point < set.point_count);
          const Key key{s.vertices[0], contact.surface().mesh.vertex_object[s.vertices[1]], s.law};
          CHECK(keys.try_emplace(s.point, key).first->second == key);
          ++count;
        }
    });
    if (model == "area_integral" || model == "ipc" || model == "ogc" || model == "clipped") CHECK(count > 5);
    const Key* last = nullptr;
    for (const auto& [point, key] : keys) {
      if (last) CHECK(*last < key);
      last = &key;
    }
  }
}

TEST_CASE("contact is asked for where it is: elsewhere it refuses, and a visit gives what a world there has", "[contact][contact_model]") {
  for (const std::string& model : Registry<ContactModel>::kind().names()) {
    INFO(model);
    TestScene scene(boxes(model));
    World& world = *scene.world;
    ContactSystem& contact = *world.contact;
    const VecX x = world.rest;
    VecX y = x;
    for (const int v : world.vertices_of(1)) y(3 * v + 1) -= 5e-4;
    const std::vector<char> all(contact.pairs().laws().size(), 1);
    contact.begin_step({x});
    CHECK_THROWS_WITH(contact.configuration(), Contains("move it to one first"));
    CHECK_THROWS_WITH(contact_points({contact, all, x}), Contains("move it there first"));
    contact.move_to(y);
    const std::vector<double> points_there = written(contact_points({contact, all, y}));
    const VecX pressures_there = pressures(world, y), gaps_there = vertex_gaps(contact, y);
    contact.move_to(x);
    const std::vector<double> points_here = written(contact_points({contact, all, x}));
    CHECK(points_here != points_there);
    CHECK_THROWS_AS(contact_points({contact, all, y}), std::logic_error);
    CHECK_THROWS_AS(pressures(world, y), std::logic_error);
    CHECK_THROWS_AS(vertex_gaps(contact, y), std::logic_error);
    CHECK_THROWS_AS(world.friction->lagged_at(y), std::logic_error);
    const auto same = [](const VecX& a, const VecX& b) { return ((a.array() == b.array()) || (a.array().isNaN() && b.array().isNaN())).all(); };
    contact.at(y, [&] {
      CHECK(written(contact_points({contact, all, y})) == points_there);
      CHECK(same(pressures(world, y), pressures_there));
      CHECK(same(vertex_gaps(contact, y), gaps_there));
    });
    CHECK(contact.configuration() == x);
    CHECK(written(contact_points({contact, all, x})) == points_here);
    CHECK(gaps_there.array().isFinite().any());
  }
}
