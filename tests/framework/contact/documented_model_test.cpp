// The contact model of docs/extending.md, which the build extracts and calls `documented_penalty`.
#include <catch2/catch.hpp>

#include <cmath>
#include <regex>

#include "framework/config/field.hpp"
#include "framework/contact/contact_model.hpp"
#include "framework/contact/terms/friction_term.hpp"
#include "framework/contact/ipc/pair_sums.hpp"
#include "framework/core/records.hpp"
#include "geometry/distance/edge_edge.hpp"
#include "geometry/distance/edge_edge_mollifier.hpp"
#include "geometry/distance/point_triangle.hpp"
#include "geometry/errors.hpp"
#include "tests/support/contact_terms.hpp"
#include "tests/support/dense_term.hpp"
#include "tests/support/scene.hpp"
#include "tests/support/test_run.hpp"

using namespace tack;

namespace {

// A crate on a floor, `gap` above it; contact acts within 5 mm.
std::string crate(const std::string& gap, const std::string& contact = "", const std::string& more = "") {
  return "gravity: [0, -10, 0]\n"
         "objects:\n"
         "  - {name: floor, shape: {type: box, size: [0.4, 0.1, 0.4], cells: [4, 1, 4]}, place: {translate: [0, -0.05, 0]}, motion: [fixed]}\n"
         "  - {name: crate, shape: {type: box, size: [0.1, 0.1, 0.1], cells: [2, 2, 2]}, place: {translate: [0.013, " + gap + ", 0.017]},\n"
         "     energies: [{type: neo_hookean, young: 10 MPa, poisson: 0.3, density: 1000}], damping: {mass: 20}" + more + "}\n"
         "contact: {distance: 5 mm, model: {type: documented_penalty, stiffness: 1 MPa/m}" + contact + "}\n";
}

}  // namespace

TEST_CASE("the documented contact model has the energy of its formula, and exact derivatives", "[documented][contact_model]") {
  TestScene scene(crate("0.052"));
  World& world = *scene.world;
  VecX x = world.rest;
  world.contact->begin_step({x});
  world.contact->move_to(x);
  // The sum over all pairs of primitives of both objects, in other words.
  const CollisionMesh& mesh = world.contact->surface().mesh;
  const auto penalty = [](double d, double area) { return d < 5e-3 ? 0.5 * 1e6 * (5e-3 - d) * (5e-3 - d) * area : 0.0; };
  double expected = 0;
  std::vector<double> tributary(x.size() / 3, 0.0), edge_area(mesh.edges.size(), 0.0);
  for (const Triangle& t : mesh.triangles) {
    const auto [a, b, c] = corners(x, t);
    const double third = (b - a).cross(c - a).norm() / 6;
    for (const int v : t) tributary[v] += third;
    for (size_t e = 0; e < mesh.edges.size(); ++e)
      if (std::ranges::count(t, mesh.edges[e][0]) && std::ranges::count(t, mesh.edges[e][1])) edge_area[e] += third;
  }
  for (const int p : mesh.vertices)
    for (const Triangle& t : mesh.triangles) {
      if (mesh.vertex_object[p] == mesh.vertex_object[t[0]]) continue;
      const auto [a, b, c] = corners(x, t);
      expected += penalty(std::sqrt(point_triangle_distance(vertex(x, p), a, b, c)), tributary[p] / 4);
    }
  for (size_t i = 0; i < mesh.edges.size(); ++i)
    for (size_t j = i + 1; j < mesh.edges.size(); ++j) {
      if (mesh.vertex_object[mesh.edges[i][0]] == mesh.vertex_object[mesh.edges[j][0]]) continue;
      const auto [a, b] = corners(x, mesh.edges[i]);
      const auto [c, d] = corners(x, mesh.edges[j]);
      const double threshold = edge_edge_mollifier_threshold(a, b, c, d), sine = (b - a).cross(d - c).squaredNorm();
      const double mollifier = sine < threshold ? sine / threshold * (2 - sine / threshold) : 1;
      expected += mollifier * penalty(std::sqrt(edge_edge_distance(a, b, c, d)), (edge_area[i] + edge_area[j]) / 4);
    }
  const ContactSet& set = world.contact->contacts();
  CHECK(set.point_triangle.size() > 0);
  CHECK(set.edge_edge.size() > 0);
  CHECK(contact_term(world).value(x) == Approx(expected).epsilon(1e-12));
  for (int v = 0; v < x.size() / 3; ++v) x.segment<3>(3 * v) += 1e-4 * Vec3(std::sin(v), std::cos(3 * v), std::sin(2 * v));
  world.contact->move_to(x);
  const VecX gradient = dense_gradient(contact_term(world), x);
  CHECK(gradient.norm() > 1);
  VecX direction = VecX::Zero(x.size());
  for (int i = 0; i < x.size(); ++i) direction(i) = std::cos(i);
  const double h = 1e-7;
  const auto value = [&](double t) {
    const VecX y = x + t * direction;
    world.contact->move_to(y);
    return contact_term(world).value(y);
  };
  CHECK((value(h) - value(-h)) / (2 * h) == Approx(gradient.dot(direction)).epsilon(1e-4));
}

TEST_CASE("with the documented contact model a crate comes to rest on the floor, and friction holds it", "[documented][contact_model]") {
  TestRun run("time: {step: 10 ms, duration: 0.6 s}\n" + crate("0.055", ", friction: {mu: 0.5, eps_v: 1 mm/s}"));
  World& world = *run.world;
  for (int step = 0; step < 60; ++step) run.step();
  REQUIRE(world.friction);
  const VecX forces = contact_term(world).forces(run.state().x, LawTerm::all);
  Vec3 on_crate = Vec3::Zero();
  for (const int v : world.vertices_of(1)) on_crate += vertex(forces, v);
  CHECK(on_crate.y() == Approx(10).epsilon(0.01));
  double normal = 0;
  for_each_record(world.friction->points(), [&](const auto& c) { normal += c.normal_force * std::abs(c.normal.y()); });
  CHECK(normal == Approx(10).epsilon(0.02));
  CHECK(world.contact->smallest_gaps(run.state().x).of_all > 0);
}

TEST_CASE("the documented contact model refuses what it does not have", "[documented][contact_model]") {
  const auto message = [](const std::string& contact) {
    try {
      TestScene scene(crate("0.055", ", " + contact));
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  using Catch::Contains;
  CHECK_THAT(message("pairs: [{between: [floor, crate], adhesion: {type: fang, peak_traction: 1 kPa}}]"),
             Contains("contact.model: documented_penalty has no adhesion of the gap between 'floor' and 'crate': it only pushes; take `adhesion` away, or choose model: area_integral"));
  // No remedy that is refused as well.
  CHECK_THAT(message("pairs: [{between: [floor, crate], adhesion: {type: bilinear, peak_traction: 1 kPa, work_of_adhesion: 1}}]"),
             Contains("documented_penalty has no adhesion by bonds") && Contains("; take `adhesion` away, or choose model: area_integral"));
  CHECK_THAT(message("barrier: {type: clamped_log}"), Contains("documented_penalty has no `barrier`: its law is that of its stiffness; take it away, or choose model: area_integral"));
  CHECK_THAT(message("pairs: [{between: [floor, crate], barrier: {type: clamped_log}}]"), Contains("documented_penalty has no `barrier` between 'floor' and 'crate'"));
  CHECK_THAT(message("safety_barrier: 0.3"),
             Contains("contact.safety_barrier is 0.3, and contact.model: documented_penalty has barriers over 1 contact distances for all pairs; take it away, or choose model: area_integral"));
  CHECK(message("safety_barrier: 1") == "accepted");
}

namespace {

// Pair sums that may be left incomplete.
enum class LeavesOut { nothing, thresholds, order };

class Incomplete : public PairSums {
 public:
  explicit Incomplete(LeavesOut leaves_out) : PairSums(PairWeights::present_area, false), leaves_out_(leaves_out) {}
  void find(const VecX& x, ContactSet& contacts) override {
    PairSums::find(x, contacts);
    if (leaves_out_ == LeavesOut::thresholds) contacts.mollifier_threshold.clear();
    if (leaves_out_ != LeavesOut::order) return;
    auto first = contacts.point_triangle.front();
    ++first.law;
    contacts.point_triangle.insert(contacts.point_triangle.begin(), first);
  }
  std::unique_ptr<ContactPotential> isolated(int, int) const override { return std::make_unique<Incomplete>(leaves_out_); }

 private:
  LeavesOut leaves_out_;
};

class IncompleteModel : public ContactModel {
 public:
  void fields(Fields& f) override {
    f.choice("leaves_out", leaves_out_, {{"nothing", LeavesOut::nothing, ""}, {"thresholds", LeavesOut::thresholds, ""}, {"order", LeavesOut::order, ""}}, "what find() forgets");
  }
  std::unique_ptr<ContactPotential> make_potential() const override { return std::make_unique<Incomplete>(leaves_out_); }

 private:
  LeavesOut leaves_out_ = LeavesOut::nothing;
};
TACK_REGISTER(ContactModel, IncompleteModel, "test_incomplete", "Leaves out what the terms need.", "");

}  // namespace

TEST_CASE("a contact model that leaves out what the terms rely on is told so", "[documented][contact_model]") {
  const auto first_find = [](const std::string& leaves_out) {
    const std::string scene_text = std::regex_replace(crate("0.052"), std::regex("type: documented_penalty, stiffness: 1 MPa/m"), "type: test_incomplete, leaves_out: " + leaves_out);
    TestScene scene(scene_text);
    scene.world->contact->begin_step({scene.world->rest});
    scene.world->contact->move_to(scene.world->rest);
  };
  CHECK_NOTHROW(first_find("nothing"));
  CHECK_THROWS_WITH(first_find("thresholds"), Catch::Contains("edge-edge stencils and 0 mollifier thresholds; call join() of framework/contact/stencils/stencil_search.hpp at the end of find()"));
  CHECK_THROWS_WITH(first_find("order"), Catch::Contains("stencils that are not sorted by law; call join()"));
}
