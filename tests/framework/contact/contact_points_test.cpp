// Contact points: their objects, features and positions. Their magnitudes add up to the normal
// force and to the area, whatever the meshes.
#include "framework/contact/points/contact_points.hpp"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <fstream>
#include <set>
#include <tuple>

#include "framework/contact/terms/contact_term.hpp"
#include "tests/support/dense_term.hpp"
#include "tests/support/scene.hpp"
#include "tests/support/silence.hpp"
#include "tests/support/contact_terms.hpp"

using namespace tack;

namespace {

// A plate of 0.1 m x 0.1 m on a larger one, 0.7 mm apart.
std::string plates(int upper_cells, int lower_cells, const std::string& weights) {
  return fmt::format(
      "objects:\n"
      "  - {{name: lower, shape: {{type: box, size: [0.16, 0.01, 0.16], cells: [{0}, 1, {0}]}},\n"
      "     place: {{translate: [0.003, -0.005, 0.002]}}, motion: [fixed]}}\n"
      "  - {{name: upper, shape: {{type: box, size: [0.1, 0.01, 0.1], cells: [{1}, 1, {1}]}},\n"
      "     place: {{translate: [0, 0.0057, 0]}}, energies: [{{type: neo_hookean, young: 1e5}}]}}\n"
      "contact:\n  distance: 1e-3\n  weights: {2}\n  barrier: {{type: clamped_log, stiffness: 1e3}}\n"
      "  pairs: [{{between: [upper, lower], integrate: upper, friction: {{mu: 0.5}},\n"
      "    adhesion: {{type: fang, young: 1e3, critical_strain: 0.1}}}}]\n",
      lower_cells, upper_cells, weights);
}

struct Sums {
  double force = 0, area = 0;
  int count = 0;
};
Sums sums(const ContactPoints& points) {
  Sums s;
  for_each_record(points, [&](const auto& c) {
    s.force += c.normal_force;
    s.area += c.area;
    ++s.count;
    CHECK(c.normal_force >= 0);
  });
  return s;
}

// Returns the vector from the opposite point to the point.
template <int K>
Vec3 separation(const ContactPoint<K>& c, const VecX& x) {
  return c.moved(x, VecX::Zero(x.size()));
}

// Checks the fields of a contact point at x.
void check_points(const ContactPoints& points, const World& world, const VecX& x) {
  const auto& object = world.contact->surface().mesh.vertex_object;
  for_each_record(points, [&]<int K>(const ContactPoint<K>& c) {
    CHECK(c.gap > 0);
    CHECK((separation(c, x) - c.gap * c.normal).norm() <= 1e-12);
    CHECK(c.normal.norm() == Approx(1).epsilon(1e-12));
    Eigen::Matrix3d frame;
    frame << c.normal, c.tangents;
    CHECK((frame.transpose() * frame - Mat3::Identity()).norm() <= 1e-12);
    double own = 0, all = 0;
    for (int i = 0; i < K; ++i) {
      CHECK(object[c.vertices[i]] == (i < c.own_vertex_count ? c.object : c.opposite));
      all += c.coefficients[i];
      if (i < c.own_vertex_count) own += c.coefficients[i];
    }
    CHECK(own == Approx(1).epsilon(1e-12));
    CHECK(std::abs(all) <= 1e-12);
    CHECK(c.area >= 0);
    switch (c.kind()) {
      case PointKind::vertex: CHECK((c.own_vertex_count == 1 && c.point == c.vertices[0])); break;
      case PointKind::interior: CHECK((c.own_vertex_count == 3 && c.point >= 0)); break;
      case PointKind::edges: CHECK((c.own_vertex_count == 2 && c.point == -1)); break;
    }
  });
}

// Returns the contact points of the wanted laws; of all laws if none are given.
ContactPoints points_at(World& world, const VecX& x, std::vector<char> wanted = {}) {
  world.contact->begin_step({x});
  world.contact->move_to(x);
  if (wanted.empty()) wanted.assign(world.contact->pairs().laws().size(), 1);
  const ContactPoints points = contact_points({*world.contact, wanted, x});
  check_points(points, world, x);
  return points;
}

// Returns the contact points of the adhesive laws; safety barrier pairs have none.
ContactPoints adhering(World& world, const VecX& x) {
  std::vector<char> wanted;
  for (const PairLaw& law : world.contact->pairs().laws(LawTerm::adhesion)) wanted.push_back(!law.laws().empty());
  return points_at(world, x, wanted);
}

}  // namespace

TEST_CASE("contact points: between plates that do not match, one for each vertex and object", "[contact][friction]") {
  for (const int upper : {2, 5, 8}) {
    for (const int lower : {1, 4, 11}) {
      INFO("cells " << upper << " on " << lower);
      TestScene scene(plates(upper, lower, "area"));
      World& world = *scene.world;
      const ContactPoints points = points_at(world, world.rest);
      std::set<int> vertices;
      for_each_record(points, [&](const auto& c) {
        CHECK(c.kind() == PointKind::vertex);
        CHECK((c.object == 1 && c.opposite == 0));
        CHECK((c.between(0, 1) && c.between(1, 0) && !c.between(1, 1)));
        CHECK(c.gap == Approx(7e-4).epsilon(1e-9));
        CHECK((c.normal - Vec3::UnitY()).norm() <= 1e-9);
        vertices.insert(c.point);
      });
      const Sums s = sums(points);
      CHECK(s.count == (upper + 1) * (upper + 1));  // whatever the features of each
      CHECK(vertices.size() == static_cast<size_t>(s.count));
      const double pressing = contact_term(world).force_between(world.rest, LawTerm::barrier, {1, 0}).y();
      CHECK(pressing > 0);
      CHECK(s.force == Approx(pressing).epsilon(1e-9));
      CHECK(s.area == Approx(0.01).epsilon(1e-6));
    }
  }
}

// A plate that hangs over the boundary of another: triangles across the boundary have interior points.
TEST_CASE("contact points: interior points represent the overlap of triangles across an overlap boundary", "[contact]") {
  for (const int upper : {1, 3, 6}) {
    INFO("cells " << upper);
    TestScene scene(fmt::format(
        "objects:\n"
        "  - {{name: lower, shape: {{type: box, size: [0.1, 0.01, 0.1], cells: [7, 1, 7]}}, motion: [fixed]}}\n"
        "  - {{name: upper, shape: {{type: box, size: [0.1, 0.01, 0.06], cells: [{0}, 1, {0}]}},\n"
        "     place: {{translate: [0.063, 0.0107, 0.001]}}, energies: [{{type: neo_hookean, young: 1e5}}]}}\n"
        "contact:\n  distance: 1e-3\n  barrier: {{type: clamped_log, stiffness: 1e3}}\n"
        "  pairs: [{{between: [upper, lower], integrate: upper, adhesion: {{type: fang, young: 1e3, critical_strain: 0.1}}}}]\n", upper));
    World& world = *scene.world;
    const ContactPoints points = adhering(world, world.rest);
    int samples = 0;
    std::set<std::tuple<PointKind, int>> places;
    for_each_record(points, [&](const auto& c) {
      CHECK((c.object == 1 && c.opposite == 0));
      CHECK((c.normal - Vec3::UnitY()).norm() <= 1e-9);
      CHECK(places.insert({c.kind(), c.point}).second);
      if (c.kind() != PointKind::interior) return;
      ++samples;
      Vec3 at = Vec3::Zero();
      for (int i = 0; i < 3; ++i) {
        CHECK(c.coefficients[i] >= -1e-12);
        at += c.coefficients[i] * vertex(world.rest, c.vertices[i]);
      }
      CHECK(at.y() == Approx(0.0057).epsilon(1e-9));
      CHECK((at.x() >= 0.013 - 1e-9 && at.x() <= 0.05 + 1e-9));  // in the overlap
    });
    CHECK(samples > 0);
    CHECK(sums(points).area == Approx(0.037 * 0.06).epsilon(1e-6));
  }
}

TEST_CASE("contact points: crossing rods have one contact point, between two edges", "[contact]") {
  const double radius = 1e-3, gap = 1e-4, angle = 50 * M_PI / 180;
  const auto rod = [&](const char* name, int edges, double turned, double y) {
    return fmt::format("  - {{name: {}, shape: {{type: segment, length: 0.08, edges: {}}}, rod: {{radius: {}}},\n"
                       "     energies: [{{type: elastic_rod, young: 1e7, density: 1000}}],\n"
                       "     place: {{axis: [0, 1, 0], angle: {}, translate: [0.001, {}, 0]}}}}\n", name, edges, radius, turned, y);
  };
  TestScene scene("objects:\n" + rod("lower", 5, 0, 0) + rod("upper", 8, angle, gap) +
                  fmt::format("contact:\n  distance: {}\n"
                              "  pairs: [{{between: [lower, upper], adhesion: {{type: fang, young: 1e4, critical_strain: 0.1}}}}]\n", 2 * gap));
  World& world = *scene.world;
  const ContactPoints points = adhering(world, world.rest);
  for_each_record(points, [&](const auto& c) {
    CHECK(c.kind() == PointKind::edges);
    CHECK(c.between(0, 1));
    CHECK(c.gap == Approx(gap).epsilon(1e-9));
    CHECK((c.normal - (c.object == 1 ? 1 : -1) * Vec3::UnitY()).norm() <= 1e-9);
  });
  CHECK(sums(points).area == Approx(4 * radius * radius / std::sin(angle)).epsilon(1e-6));
}

// Two sheets of one object come close: each faces its own object.
TEST_CASE("contact points: points of a body that touches itself face their own object", "[contact]") {
  const TemporaryFolder folder;
  const auto file = folder.path() / "sheets.obj";
  std::ofstream(file) << "v 0 0 0\nv 0 0 0.1\nv 0.1 0 0.1\nv 0.1 0 0\nf 1 2 3\nf 1 3 4\n"
                         "v 0 0.02 0\nv 0 0.02 0.1\nv 0.1 0.02 0.1\nv 0.1 0.02 0\nf 5 6 7\nf 5 7 8\n";
  TestScene scene(fmt::format("objects:\n  - {{name: sheets, shape: {{type: file, path: {}}}, shell: {{thickness: 1e-4}},\n"
                              "     energies: [{{type: stvk_membrane, young: 1e5, density: 1000}}]}}\n"
                              "contact: {{distance: 1e-3, barrier: {{type: clamped_log, stiffness: 1e3}}}}\n", file.string()));
  World& world = *scene.world;
  VecX x = world.rest;
  for (int v = 0; v < x.size() / 3; ++v)
    if (x(3 * v + 1) > 0.01) x(3 * v + 1) = 5e-4;
  const ContactPoints points = points_at(world, x);
  std::set<int> vertices;
  double area = 0;
  for_each_record(points, [&](const auto& c) {
    CHECK((c.object == 0 && c.opposite == 0 && c.objects() == std::array{0, 0}));
    if (c.kind() != PointKind::vertex) return;
    CHECK(vertices.insert(c.point).second);
    const bool above = x(3 * c.point + 1) > 0;
    CHECK((c.normal - (above ? 1 : -1) * Vec3::UnitY()).norm() <= 1e-9);
    CHECK(c.gap == Approx(5e-4).epsilon(1e-9));
    area += c.area;
  });
  CHECK(vertices.size() == 8);
  CHECK(area == Approx(0.01).epsilon(1e-6));  // both sides, half each
}

// Plain sums count area several times; friction follows the forces that they give. Those of a few pairs of
// edges lean.
TEST_CASE("contact points: the forces of plain sums add up too", "[contact][friction]") {
  TestScene scene(plates(5, 4, "pair"));
  World& world = *scene.world;
  const Sums s = sums(points_at(world, world.rest));
  const double pressing = contact_term(world).force_between(world.rest, LawTerm::barrier, {1, 0}).y();
  CHECK(s.force == Approx(pressing).epsilon(1e-3));
}

// The floor's points see the facets, edges and vertices of the ball, with weights of both signs; their
// normals differ by a little.
TEST_CASE("contact points: the forces of a ball on a floor add up", "[contact][friction]") {
  TestScene scene(
      "objects:\n"
      "  - {name: floor, shape: {type: box, size: [0.06, 0.01, 0.06], cells: [60, 1, 60]},\n"
      "     place: {translate: [0.0003, -0.005, 0.0002]}, motion: [fixed]}\n"
      "  - {name: ball, shape: {type: sphere, radius: 0.1, cells: 16}, place: {translate: [0, 0.1004, 0]},\n"
      "     energies: [{type: neo_hookean, young: 1e5}]}\n"
      "contact: {distance: 1e-3, friction: {mu: 0.5}}\n");
  World& world = *scene.world;
  const Sums s = sums(points_at(world, world.rest));
  const Vec3 pressing = contact_term(world).force_between(world.rest, LawTerm::barrier, {1, 0});
  CHECK(s.count > 20);
  CHECK(s.force == Approx(pressing.y()).epsilon(0.01));
}

// The four lower corners of a blade in a groove: its walls are faced at two contact points each if it is steep, at one if
// it is nearly flat.
TEST_CASE("contact points: features whose normals agree are one", "[contact][friction]") {
  const auto contacts_in_groove = [](double steepness) {
    const TemporaryFolder folder;
    const auto file = folder.path() / "groove.obj";
    std::ofstream(file) << fmt::format(
        "v -0.1 {0} -0.1\nv -0.1 {0} 0.1\nv 0 0 -0.1\nv 0 0 0.1\nv 0.1 {0} -0.1\nv 0.1 {0} 0.1\n"
        "f 1 2 3\nf 2 4 3\nf 3 4 5\nf 4 6 5\n", 0.1 * steepness);
    const double gap = 5e-4 * std::hypot(1, steepness);  // above the bottom line: 0.5 mm from both walls
    TestScene scene(fmt::format(
        "objects:\n"
        "  - {{name: groove, shape: {{type: file, path: {}}}, motion: [fixed]}}\n"
        "  - {{name: blade, shape: {{type: box, size: [1e-4, 0.01, 0.01]}},\n"
        "     place: {{translate: [0, {}, 0.003]}}, energies: [{{type: neo_hookean, young: 1e5}}]}}\n"
        "contact: {{distance: 1e-3, safety_barrier: 0.01, friction: {{mu: 0.5}},\n"
        "  pairs: [{{between: [blade, groove], integrate: blade}},\n"
        "          {{between: [blade, blade], contact: false}}]}}\n", file.string(), 0.005 + gap));
    World& world = *scene.world;
    const Sums s = sums(points_at(world, world.rest));
    CHECK(s.force > 0);
    return s.count;
  };
  CHECK(contacts_in_groove(2) == 8);
  CHECK(contacts_in_groove(0.1) == 4);
}
