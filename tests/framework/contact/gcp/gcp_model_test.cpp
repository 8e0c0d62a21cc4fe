// The contact models gcp and ogc in a world.
#include <catch2/catch.hpp>

#include "framework/contact/points/contact_points.hpp"
#include "framework/contact/gcp/gcp_points.hpp"
#include "tests/support/contact_terms.hpp"
#include "tests/support/dense_term.hpp"
#include "tests/support/scene.hpp"

using namespace tack;
using Catch::Contains;

namespace {

const std::vector<std::string> models = {"gcp", "ogc"};

std::string boxes(const std::string& model, const std::string& pair = "", const std::string& more = "") {
  return "objects:\n"
         "  - {name: a, shape: {type: box, size: [0.1, 0.1, 0.1], cells: [2, 2, 2]}, energies: [{type: neo_hookean, young: 1e5, density: 1000}]}\n"
         "  - {name: b, shape: {type: box, size: [0.1, 0.1, 0.1], cells: [3, 3, 3]}, place: {axis: [1, 0, 0], angle: 0.3 rad, translate: [0.102, 0.01, 0.02]}, motion: [fixed]}\n" +
         more + "contact: {distance: 5 mm, friction: {mu: 0.5}, model: " + model + (pair.empty() ? "" : ", pairs: [{between: [a, b], " + pair + "}]") + "}\n";
}

}  // namespace

TEST_CASE("contact models gcp and ogc: derivatives, momentum and contact points in a world", "[contact_model]") {
  for (const std::string& model : models) {
    INFO(model);
    TestScene scene(boxes(model));
    World& world = *scene.world;
    const VecX x = world.rest;
    world.contact->begin_step({x});
    const Term& term = *world.contact->potential().terms().at(0);
    const auto value_at = [&](const VecX& y) {
      world.contact->move_to(y);
      return term.value(y);
    };
    world.contact->move_to(x);
    const VecX gradient = dense_gradient(term, x);
    CHECK(term.value(x) > 0);
    // The vertices of b are fixed: stencils of b alone are left out, and forces on its vertices are whole.
    CHECK(total(gradient).norm() <= 1e-10 * gradient.cwiseAbs().sum());
    CHECK(total_moment(x, gradient).norm() <= 1e-10 * gradient.cwiseAbs().sum());
    const VecX slopes = gradient_by_differences(value_at, x, 1e-8);
    world.contact->move_to(x);
    for (int v = 0; v < x.size() / 3; ++v)
      if (world.body_of(v) == 0) CHECK((vertex(slopes, v) - vertex(gradient, v)).norm() <= 1e-5 * gradient.lpNorm<Eigen::Infinity>());
    // Contact points: coefficients of the gap, and forces along it that add up to the normal part.
    Vec3 force = Vec3::Zero();
    int count = 0;
    for_each_record(contact_points({*world.contact, std::vector<char>(world.contact->pairs().laws().size(), 1), x}), [&](const auto& c) {
      Vec3 separation = Vec3::Zero();
      double sum = 0;
      for (size_t i = 0; i < c.vertices.size(); ++i) separation += c.coefficients[i] * vertex(x, c.vertices[i]), sum += c.coefficients[i];
      CHECK(std::abs(sum) < 1e-12);
      CHECK((separation - c.gap * c.normal).norm() < 1e-9);
      CHECK(c.normal_force >= 0);
      CHECK(c.area > 0);
      force += (c.object == 0 ? 1 : -1) * c.normal_force * c.normal;
      ++count;
    });
    CHECK(count > 5);
    Vec3 expected = Vec3::Zero();
    for (int v = 0; v < x.size() / 3; ++v)
      if (world.body_of(v) == 0) expected -= vertex(gradient, v);
    CHECK((force - expected).norm() <= (model == "gcp" ? 0.5 : 0.02) * expected.norm());  // gcp: without the directional factors
  }
}

TEST_CASE("contact models gcp and ogc: what they do not have is refused at its line, with a remedy", "[contact_model]") {
  const auto refuses = [](const std::string& scene, const std::string& line, const std::string& message) {
    CHECK_THROWS_WITH(TestScene(scene), Contains(line) && Contains(message));
  };
  for (const std::string& model : models) {
    refuses(boxes(model, "adhesion: {type: fang, peak_traction: 1 kPa}"), ":5:", "choose model: area_integral");
    refuses(boxes(model, "adhesion: {type: rcc, normal_stiffness: 1e8 Pa/m, work_of_adhesion: 1 J/m^2}"), ":5:", model + " has no adhesion by bonds");
    refuses(boxes(model, "integrate: a"), ":5:", model + " has no `integrate`");
  }
}
