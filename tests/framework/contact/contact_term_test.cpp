#include "framework/contact/terms/contact_term.hpp"

#include <catch2/catch.hpp>

#include "tests/support/dense_term.hpp"
#include "tests/support/scene.hpp"
#include "tests/support/tet_body.hpp"
#include "tests/support/three_boxes.hpp"
#include "tests/support/contact_terms.hpp"

using namespace tack;

namespace {

// Three small boxes around each other, askew; between two of them all edges are nearly parallel.
std::string cluster(const std::string& contact) {
  return three_boxes() +
         "contact: {distance: 0.025, safety_barrier: 1, " + contact +
         "barrier: {type: clamped_log, stiffness: 1e3},\n"
         "  pairs: [{between: [a, b], adhesion: {type: fang, young: 1e3, critical_strain: 0.5}},\n"
         "          {between: [b, c], integrate: both, adhesion: {type: fang, form: squared, young: 1e3, critical_strain: 0.5}}]}\n";
}

struct Cluster {
  explicit Cluster(const std::string& contact) : scene(cluster(contact)) {
    RandomMotions random(11);
    x = scene.world->rest + 1e-3 * random.vectors(scene.world->rest.size());
    system().begin_step({x});
    system().move_to(x);
  }
  ContactSystem& system() { return *scene.world->contact; }
  const ContactTerm& term() { return contact_term(*scene.world); }

  TestScene scene;
  VecX x;
};

const std::vector<std::string> weightings = {"", "model: ipc, ", "model: {type: ipc, weights: rest_area, inclusion_exclusion: true}, "};

int nearly_parallel(const ContactSet& set, const VecX& x) {
  int count = 0;
  for (size_t i = 0; i < set.edge_edge.size(); ++i) {
    const auto& v = set.edge_edge[i].vertices;
    const Vec3 a = vertex(x, v[1]) - vertex(x, v[0]), b = vertex(x, v[3]) - vertex(x, v[2]);
    count += a.cross(b).squaredNorm() < set.mollifier_threshold[i];
  }
  return count;
}

}  // namespace

TEST_CASE("contact: gradient and Hessian are those of the value, all stencils active", "[contact]") {
  for (const std::string& weights : weightings) {
    Cluster c(weights);
    INFO(weights);
    const ContactSet& set = c.system().contacts();
    CHECK(set.point_point.size() > 0);
    CHECK(set.point_edge.size() > 0);
    CHECK(set.point_triangle.size() > 0);
    CHECK(set.edge_edge.size() > 0);
    CHECK(nearly_parallel(set, c.x) > 3);
    const VecX gradient = dense_gradient(c.term(), c.x);
    const MatX hessian = dense_hessian(c.term(), c.x, Projection::none);
    const auto value_at = [&](const VecX& y) {
      c.system().move_to(y);
      return c.term().value(y);
    };
    const auto gradient_at = [&](const VecX& y) {
      c.system().move_to(y);
      return dense_gradient(c.term(), y);
    };
    constexpr double step = 1e-7;
    const VecX slopes = gradient_by_differences(value_at, c.x, step);
    const MatX curvatures = hessian_by_differences(gradient_at, c.x, step);
    CHECK((slopes - gradient).lpNorm<Eigen::Infinity>() <= 1e-6 * gradient.lpNorm<Eigen::Infinity>());
    CHECK((curvatures - hessian).cwiseAbs().maxCoeff() <= 1e-5 * hessian.cwiseAbs().maxCoeff());
  }
}

TEST_CASE("contact: projected stencils are positive semi-definite", "[contact]") {
  for (const std::string& weights : weightings) {
    Cluster c(weights);
    const MatX exact = dense_hessian(c.term(), c.x, Projection::none);
    for (const Projection projection : {Projection::clamp, Projection::absolute}) {
      for_each_stencil_hessian(c.term(), c.x, projection, [](const MatX& h, const int*) {
        REQUIRE(smallest_eigenvalue(h) >= -1e-12 * h.cwiseAbs().maxCoeff());
      });
      const MatX lifted = dense_hessian(c.term(), c.x, projection) - exact;
      CHECK(smallest_eigenvalue(lifted) >= -1e-10 * exact.cwiseAbs().maxCoeff());
    }
  }
}

TEST_CASE("contact: forces and moments add up to zero", "[contact]") {
  for (const std::string& weights : weightings) {
    Cluster c(weights);
    for (const LawTerm term : {LawTerm::all, LawTerm::barrier, LawTerm::adhesion}) {
      const VecX force = c.term().forces(c.x, term);
      const double scale = force.cwiseAbs().sum();
      CHECK(scale > 0);
      CHECK(total(force).norm() <= 1e-12 * scale);
      CHECK(total_moment(c.x, force).norm() <= 1e-12 * scale);
    }
  }
}

TEST_CASE("contact: law terms and pairs add up to the total", "[contact]") {
  Cluster c(weightings[0]);
  const VecX all = c.term().forces(c.x, LawTerm::all);
  const VecX terms = c.term().forces(c.x, LawTerm::barrier) + c.term().forces(c.x, LawTerm::adhesion);
  CHECK((all + dense_gradient(c.term(), c.x)).norm() <= 1e-12 * all.norm());
  CHECK((all - terms).norm() <= 1e-12 * all.norm());
  CHECK(c.term().value(c.x) == Approx(c.term().term_value(c.x, LawTerm::barrier) +
                                      c.term().term_value(c.x, LawTerm::adhesion)));
  VecX pairs = VecX::Zero(all.size());
  for (int a = 0; a < 3; ++a)
    for (int b = a; b < 3; ++b) pairs += c.term().forces(c.x, LawTerm::all, ObjectPair{a, b});
  CHECK((all - pairs).norm() <= 1e-12 * all.norm());
  const Vec3 action = c.term().force_between(c.x, LawTerm::all, {0, 1});
  const Vec3 reaction = c.term().force_between(c.x, LawTerm::all, {1, 0});
  CHECK(action.norm() > 0);
  CHECK((action + reaction).norm() <= 1e-12 * all.norm());
}

TEST_CASE("contact: objects out of range exert no force", "[contact]") {
  Cluster c(weightings[0]);
  for (int v = 27; v < 81; ++v) vertex(c.x, v) += Vec3(v < 54 ? 5 : -5, 0, 0);
  c.system().move_to(c.x);
  CHECK(c.system().contacts().size() == 0);
  CHECK(c.term().value(c.x) == 0);
  CHECK(dense_gradient(c.term(), c.x).norm() == 0);
}

TEST_CASE("contact: exactly parallel edges have finite derivatives", "[contact]") {
  TestScene scene(
      "objects:\n"
      "  - {name: a, shape: {type: box, size: [0.1, 0.1, 0.1]}, energies: [{type: neo_hookean, young: 1e5}]}\n"
      "  - {name: b, shape: {type: box, size: [0.1, 0.1, 0.1]}, place: {translate: [0.102, 0.102, 0]},\n"
      "     energies: [{type: neo_hookean, young: 1e5}]}\n"
      "contact: {distance: 0.01, safety_barrier: 1}\n");
  const VecX& x = scene.world->rest;
  scene.world->contact->move_to(x);
  CHECK(nearly_parallel(scene.world->contact->contacts(), x) > 0);
  CHECK(std::isfinite(contact_term(*scene.world).value(x)));
  CHECK(dense_gradient(contact_term(*scene.world), x).allFinite());
  CHECK(dense_hessian(contact_term(*scene.world), x, Projection::clamp).allFinite());
}
