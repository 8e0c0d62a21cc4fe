#include "framework/output/frame_fields.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "framework/contact/terms/contact_term.hpp"
#include "framework/contact/terms/friction_term.hpp"
#include "framework/output/element_fields.hpp"
#include "framework/output/output_config.hpp"
#include "framework/world/world.hpp"
#include "geometry/errors.hpp"
#include "tests/support/scene.hpp"

using namespace tack;

namespace {

FrameGeometry geometry_of(const World& world) {
  FrameGeometry g;
  g.vertices = world.mesh_vertex_count();
  for (const Body& body : world.bodies) {
    g.tets.insert(g.tets.end(), body.tets.begin(), body.tets.end());
    g.triangles.insert(g.triangles.end(), body.sheet.begin(), body.sheet.end());
    g.edges.insert(g.edges.end(), body.edges.begin(), body.edges.end());
    g.points.insert(g.points.end(), body.points.begin(), body.points.end());
  }
  return g;
}

struct Framed {
  explicit Framed(const std::string& objects, const std::string& contact)
      : scene("objects:\n  - {name: floor, shape: {type: box, size: [4, 0.1, 4], cells: [20, 1, 20]}, place: {translate: [0, -0.05, 0]}, motion: [fixed]}\n" +
              objects + "contact: {distance: 2e-3, friction: {mu: 0.5, eps_v: 0.1}, " + contact + "}\n") {
    state = scene.world->start;
    scene.world->contact->begin_step({state.x});
    scene.world->contact->move_to(state.x);
  }
  VecX field(const std::string& name, int components = 1) {
    const auto fields = vertex_fields({name}, *scene.world, state, geometry);
    REQUIRE(fields.size() == 1);
    CHECK(fields[0].name == name);
    CHECK(fields[0].components == components);
    return fields[0].values;
  }
  const Body& body(const std::string& name) const { return scene.world->bodies[scene.world->body_index(name)]; }
  // Barrier pressure between a body and the floor at a gap.
  double law(const std::string& name, double gap) const {
    const PairTable& pairs = scene.world->contact->pairs();
    const int a = scene.world->body_index(name);
    const int law = body(name).triangles.empty() ? pairs.codimensional(a, 0).law : pairs.point(a, 0).law;
    return -pairs.laws()[law].at(gap).slope;
  }
  // Vertices of a body at the height y.
  std::vector<int> at_height(const std::string& name, double y) const {
    std::vector<int> found;
    const Body& b = body(name);
    for (int v = b.first_vertex; v < b.first_vertex + b.vertex_count; ++v)
      if (std::abs(state.x(3 * v + 1) - y) < 1e-9) found.push_back(v);
    return found;
  }

  TestScene scene;
  State state;
  FrameGeometry geometry = geometry_of(*scene.world);
};

const std::string block = "  - {name: block, shape: {type: box, size: [1, 1, 1], cells: [4, 2, 4]}, place: {translate: [0, 0.501, 0]},\n"
                          "     energies: [{type: neo_hookean, young: 1e6}]}\n";

}  // namespace

TEST_CASE("an evenly pressed block has uniform contact pressure up to its edges", "[fields]") {
  Framed f(block, "pairs: []");
  const VecX pressure = f.field("contact_pressure"), force = f.field("contact_force", 3);
  double total = 0;
  for (const int v : f.at_height("block", 0.001)) total += force(3 * v + 1);
  CHECK(total == Approx(f.law("block", 0.001)).epsilon(0.2));  // as well as points count the area of 1 m^2
  for (const int v : f.at_height("block", 0.001)) CHECK(pressure(v) == Approx(f.law("block", 0.001)).epsilon(1e-6));
  for (const int v : f.at_height("block", 1.001)) CHECK(pressure(v) == 0);
  const VecX gap = f.field("gap");
  for (const int v : f.at_height("block", 0.001)) CHECK(gap(v) == Approx(0.001).epsilon(1e-9));
  for (const int v : f.at_height("block", 1.001)) CHECK(std::isnan(gap(v)));
  // A vertex inside has no surface.
  for (const int v : f.at_height("block", 0.501)) CHECK(std::isnan(pressure(v)) == (std::hypot(f.state.x(3 * v), f.state.x(3 * v + 2)) < 0.4));
}

TEST_CASE("adhesion pressure is positive in tension, and contact pressure is then negative", "[fields]") {
  std::string far = block;
  far.replace(far.find("0.501"), 5, "0.503");  // beyond the barrier
  Framed f(far, "pairs: [{between: [block, floor], adhesion: {type: fang, peak_traction: 3 kPa}}]");
  const VecX pressure = f.field("contact_pressure"), adhesion = f.field("adhesion_pressure"), force = f.field("adhesion_force", 3);
  double total = 0;
  for (const int v : f.at_height("block", 0.003)) total -= force(3 * v + 1);
  const double traction = -f.law("block", 0.003);
  CHECK(traction > 100);
  CHECK(total == Approx(traction).epsilon(1e-6));  // of an area of 1 m^2, which is divided where things adhere
  for (const int v : f.at_height("block", 0.003)) {
    CHECK(adhesion(v) == Approx(traction).epsilon(1e-6));
    CHECK(pressure(v) == Approx(-traction).epsilon(1e-6));
  }
}

TEST_CASE("adhesion pressure of sheets, rods and particles is positive in tension", "[fields]") {
  Framed f("  - {name: rod, shape: {type: segment, length: 1, edges: 4}, rod: {radius: 5 mm}, place: {translate: [0, 0.003, 1]}, energies: [{type: elastic_rod, young: 1e9}]}\n"
           "  - {name: dust, shape: {type: points, size: [1, 0, 1], counts: [2, 1, 2]}, particle: {radius: 5 mm}, place: {translate: [0, 0.003, -1]}, energies: [particle]}\n"
           "  - {name: sheet, shape: {type: grid, size: [1, 1], cells: [4, 4]}, shell: {thickness: 1 mm}, place: {translate: [1.3, 0.003, 0]}, energies: [{type: stvk_membrane, young: 1e6}]}\n"
           "  - {name: below, shape: {type: grid, size: [1, 1], cells: [4, 4]}, shell: {thickness: 1 mm}, place: {translate: [1.3, -0.103, 0]}, energies: [{type: stvk_membrane, young: 1e6}]}\n",
           "pairs: [{between: [rod, floor], adhesion: {type: fang, peak_traction: 3 kPa}}, {between: [dust, floor], adhesion: {type: fang, peak_traction: 3 kPa}},\n"
           "         {between: [sheet, floor], adhesion: {type: fang, peak_traction: 3 kPa}}, {between: [below, floor], adhesion: {type: fang, peak_traction: 3 kPa}}]");
  const VecX pressure = f.field("contact_pressure"), adhesion = f.field("adhesion_pressure");
  for (const auto& [name, height] : {std::pair{"rod", 0.003}, {"dust", 0.003}, {"sheet", 0.003}, {"below", -0.103}}) {
    INFO(name);
    const double traction = -f.law(name, 0.003);
    CHECK(traction > 100);
    REQUIRE_FALSE(f.at_height(name, height).empty());
    for (const int v : f.at_height(name, height)) {
      CHECK(adhesion(v) == Approx(traction).epsilon(0.02));
      CHECK(pressure(v) == Approx(-adhesion(v)));
    }
  }
}

TEST_CASE("friction traction of sliding surfaces is mu times the pressure", "[fields]") {
  Framed f(block, "pairs: []");
  VecX moved = f.state.x;
  for (int v = f.body("block").first_vertex; v < f.body("block").first_vertex + f.body("block").vertex_count; ++v) moved(3 * v) += 1e-4;
  FrictionTerm& friction = *f.scene.world->friction;
  const double h = 1e-4;
  friction.begin_step({f.state.x, 0, h});
  friction.lag(f.state.x);
  f.state.x = moved;
  f.scene.world->contact->move_to(moved);
  const VecX traction = f.field("friction_traction"), pressure = f.field("contact_pressure");
  for (const int v : f.at_height("block", 0.001)) CHECK(traction(v) == Approx(0.5 * pressure(v)).epsilon(1e-2));
}

TEST_CASE("rods, particles, sheets and affine bodies have pressures and gaps", "[fields]") {
  Framed f("  - {name: rod, shape: {type: segment, length: 1, edges: 4}, rod: {radius: 5 mm}, place: {translate: [0, 0.001, 1]}, energies: [{type: elastic_rod, young: 1e9}]}\n"
           "  - {name: dust, shape: {type: points, size: [1, 0, 1], counts: [2, 1, 2]}, particle: {radius: 5 mm}, place: {translate: [0, 0.001, -1]}, energies: [particle]}\n"
           "  - {name: sheet, shape: {type: grid, size: [1, 1], cells: [4, 4]}, shell: {thickness: 1 mm}, place: {translate: [1.3, 0.001, 0]}, energies: [{type: stvk_membrane, young: 1e6}]}\n"
           "  - {name: stone, shape: {type: box, size: [0.5, 0.5, 0.5]}, place: {translate: [-1, 0.251, 0]}, body: {type: affine, density: 1000}}\n",
           "pairs: []");
  const VecX pressure = f.field("contact_pressure"), gap = f.field("gap"), force = f.field("contact_force", 3);
  const auto check = [&](const char* name, double height, double area) {
    double total = 0;
    for (const int v : f.at_height(name, height)) total += force(3 * v + 1);
    INFO(name);
    CHECK(total == Approx(f.law(name, 0.001) * area).epsilon(0.5));  // as well as the floor's points count its area
    for (const int v : f.at_height(name, height)) {
      CHECK(pressure(v) == Approx(f.law(name, 0.001)).epsilon(1e-6));
      CHECK(gap(v) > 0);
      CHECK(gap(v) < 0.002);
    }
  };
  check("rod", 0.001, 0.01 * 1);
  check("dust", 0.001, 4 * M_PI * 25e-6);
  check("sheet", 0.001, 1);
  check("stone", 0.001, 0.25);
}

TEST_CASE("stretches and stresses of elements agree with prescribed strains", "[fields]") {
  TestScene s(
      "objects:\n"
      "  - {name: solid, shape: {type: box, size: [1, 1, 1]}, energies: [{type: stvk_hencky, young: 1e5, poisson: 0}]}\n"
      "  - {name: sheet, shape: {type: grid, size: [1, 1]}, place: {translate: [0, 3, 0]}, shell: {thickness: 1 cm}, energies: [{type: stvk_membrane, young: 1e5}]}\n"
      "  - {name: rod, shape: {type: segment, length: 1, edges: 2}, place: {translate: [0, 5, 0]}, rod: {radius: 1 cm}, energies: [{type: elastic_rod, young: 1e5}]}\n");
  const FrameGeometry geometry = geometry_of(*s.world);
  VecX x = s.world->rest;
  for (int v = 0; v < geometry.vertices; ++v) x(3 * v) *= 1.2, x(3 * v + 2) *= 0.9;
  const auto fields = element_fields({"stretches", "cauchy_stress", "von_mises_stress"}, *s.world, x, geometry);
  REQUIRE(fields.size() == 3);
  CHECK(fields[0].components == 3);
  CHECK(fields[1].components == 6);
  const auto tets = static_cast<int>(geometry.tets.size()), triangles = static_cast<int>(geometry.triangles.size());
  for (int c = 0; c < tets; ++c) {
    CHECK(fields[0].values(3 * c) == Approx(1.2));
    CHECK(fields[0].values(3 * c + 1) == Approx(1.0));
    CHECK(fields[0].values(3 * c + 2) == Approx(0.9));
    // With no Poisson ratio, Hencky's stress is E log(stretch) / J in each direction.
    const double j = 1.2 * 0.9;
    CHECK(fields[1].values(6 * c) == Approx(1e5 * std::log(1.2) / j));
    CHECK(fields[1].values(6 * c + 1) == Approx(0).margin(1e-6));
    CHECK(fields[1].values(6 * c + 2) == Approx(1e5 * std::log(0.9) / j));
    for (int k = 3; k < 6; ++k) CHECK(fields[1].values(6 * c + k) == Approx(0).margin(1e-6));
  }
  for (int c = tets; c < tets + triangles; ++c) {
    CHECK(fields[0].values(3 * c) == Approx(1.2));
    CHECK(fields[0].values(3 * c + 1) == Approx(0.9));
    CHECK(std::isnan(fields[0].values(3 * c + 2)));
  }
  CHECK(fields[0].values(3 * (tets + triangles)) == Approx(1.2));
  CHECK(std::isnan(fields[0].values(3 * (tets + triangles) + 1)));
}

TEST_CASE("an unknown field is refused with the nearest name", "[fields]") {
  OutputConfig config;
  const Fields fields = fields_of(config);
  const auto error = [&] {
    std::string all;
    for (const auto& check : fields.checks()) all += check.condition();
    return all;
  };
  config.frame_fields = {"contact_presure"};
  CHECK_THAT(error(), Catch::Contains("did you mean 'contact_pressure'?"));
  for (const FrameFieldInfo& info : frame_fields()) {
    config.frame_fields = {info.name};
    CHECK(error().empty());
  }
}
