// Damping of the strain rate, for every energy on solids, sheets and rods:
// - no rigid motion is damped, at any stress, and forces have no moment
// - small strains are damped with beta K
// - derivatives are those of the value
#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <set>

#include "framework/core/damping_terms.hpp"
#include "framework/core/strain_view.hpp"
#include "framework/scene/energy.hpp"
#include "framework/scene/energy_with_unknowns.hpp"
#include "geometry/errors.hpp"
#include "tests/support/component_variants.hpp"
#include "tests/support/dense_term.hpp"
#include "tests/support/rod_body.hpp"
#include "tests/support/sheet_body.hpp"
#include "tests/support/tet_body.hpp"

using namespace tack;

namespace {

constexpr double beta = 2e-3, h = 1e-3;  // s

// A body of any kind, and how it moves rigidly.
struct DampedBody {
  const Body* body;
  const VecX* rest;
  const RodBody* rod = nullptr;

  VecX moved(const VecX& x, const Mat3& r, const Vec3& d) const {
    if (rod) return rod->moved(x, r, d);
    VecX y = x;
    for (int v = 0; v < x.size() / 3; ++v) vertex(y, v) = r * vertex(x, v) + d;
    return y;
  }
  // Numbers are one of three.
  VecX positions(VecX field) const {
    if (rod)
      for (const int twist : rod->frames->twists()) field(3 * twist + 1) = field(3 * twist + 2) = 0;
    return field;
  }
  // Returns the moment of the forces: their work in small rotations about each axis, per angle.
  Vec3 moment(const VecX& x, const VecX& forces) const {
    constexpr double angle = 1e-5;
    const auto turned = [&](int axis, double by) { return moved(x, Eigen::AngleAxisd(by, Vec3::Unit(axis)).toRotationMatrix(), Vec3::Zero()); };
    Vec3 sum;
    for (int axis = 0; axis < 3; ++axis) sum(axis) = forces.dot(turned(axis, angle) - turned(axis, -angle)) / (2 * angle);
    return sum;
  }
};

// check(elastic, shape) for every energy in every variant, on each body that takes it.
template <class Check>
void for_each_energy(const Check& check) {
  static const TetBody linear(Vec3(0.1, 0.07, 0.05), {1, 1, 1}), composite(Vec3(0.1, 0.07, 0.05), {1, 1, 1}, Elements::composite),
      patches(Vec3(0.1, 0.07, 0.05), {1, 1, 1}, Elements::patches);
  static const SheetBody sheet(Vec2(0.1, 0.08), {3, 2}, 1e-3);
  static const RodBody rod({{0, 0, 0}, {0.03, 0.01, 0}, {0.06, 0, 0.01}, {0.08, 0.02, 0.01}}, {{0, 1}, {1, 2}, {2, 3}}, {0, 3e-3, 2e-3, Vec3(0, 0, 1)});
  const DampedBody shapes[] = {{&linear.body, &linear.rest}, {&composite.body, &composite.rest}, {&patches.body, &patches.rest}, {&sheet.body, &sheet.rest}, {&rod.body, &rod.rest, &rod}};
  std::set<std::string> checked;
  for (const ComponentVariant& v : variants<Energy>({{}, {{"poisson", "0.45"}}, {{"stiffness", "1e-3"}}, {{"modulus", "1e4"}}, {{"activation_energy", "6e4"}}, {{"modulus", "1e4"}, {"activation_energy", "6e4"}}})) {
    if (v.type.starts_with("toy_") || v.type == "remembering") continue;  // components of other tests
    for (const DampedBody& shape : shapes) {
      const auto energy = component<Energy>(v.yaml);
      if (dynamic_cast<const EnergyWithUnknowns*>(energy.get()) || (shape.body->elements != Elements::linear && !energy->takes_elements())) continue;
      std::unique_ptr<Term> term;
      try {
        term = energy->make_term(*shape.body, *shape.rest);
      } catch (const InputError&) {
        continue;  // not available for such a body
      }
      if (!term || term->dynamic()) continue;
      term->load_history({});
      term->begin_step({*shape.rest, 0, h});
      // Terms that depend on the orientation in space are left out: they are damped in their rotation as well.
      const Mat3 turn = Eigen::AngleAxisd(0.4, Vec3(1, 2, 3).normalized()).toRotationMatrix();
      RandomMotions random(9);
      const VecX x = *shape.rest + shape.positions(2e-4 * random.vectors(shape.rest->size()));
      if (term->value(x) == 0) continue;  // a limit of larger strains
      if (std::abs(term->value(shape.moved(x, turn, Vec3::Zero())) - term->value(x)) > 1e-6 * term->value(x)) continue;
      INFO(v.yaml << ", elements " << static_cast<int>(shape.body->elements));
      checked.insert(v.type);
      check(*term, shape);
    }
  }
  for (const char* type : {"neo_hookean", "fixed_corotated", "stvk_hencky", "von_mises", "stvk_membrane", "neo_hookean_membrane", "von_mises_membrane", "hinge_bending", "elastic_rod", "string"})
    CHECK(checked.contains(type));
}

// A step has begun from x.
std::unique_ptr<DampingTerm> begun(Term& elastic, const VecX& x) {
  auto damping = stiffness_damping(elastic, beta);
  elastic.begin_step({x, 0, h});
  damping->begin_step({x, 0, h});
  return damping;
}

}  // namespace

TEST_CASE("damping of strain: no rigid motion is damped, and forces have no moment", "[damping]") {
  for_each_energy([](Term& elastic, const DampedBody& shape) {
    RandomMotions random(4);
    const VecX x = *shape.rest + shape.positions(5e-4 * random.vectors(shape.rest->size()));
    const auto damping = begun(elastic, x);
    const VecX strained = x + shape.positions(5e-4 * random.vectors(x.size()));
    const double scale = damping->value(strained);
    REQUIRE(scale > 0);
    for (const double angle : {1e-3, 0.1, 1.0}) {
      const Mat3 turn = Eigen::AngleAxisd(angle, random.vector().normalized()).toRotationMatrix();
      const VecX rigid = shape.moved(x, turn, 0.1 * random.vector());
      CHECK(damping->value(rigid) <= 1e-12 * scale);
      CHECK(damping->dissipated(rigid) <= 1e-12 * scale);
      CHECK(damping->value(shape.moved(strained, turn, Vec3::Zero())) == Approx(scale).epsilon(1e-9));
    }
    const VecX gradient = dense_gradient(*damping, strained);
    CHECK(shape.moment(strained, gradient).norm() <= 1e-8 * gradient.cwiseAbs().sum() * 0.1);
    VecX mean = VecX::Zero(x.size());
    damping->add_mean_forces(strained, mean);
    CHECK((mean + gradient).norm() <= 1e-9 * gradient.norm());
    CHECK(damping->dissipated(strained) == Approx(2 * scale));
  });
}

TEST_CASE("damping of strain: a spin that the integrator continues is not damped", "[damping]") {
  for_each_energy([](Term& elastic, const DampedBody& shape) {
    const VecX& x = *shape.rest;
    const Vec3 spin(30, -20, 50);  // rad/s
    VecX v = VecX::Zero(x.size());
    for (int i = 0; i < shape.body->vertex_count; ++i) vertex(v, i) = spin.cross(Vec3(vertex(x, i)));
    if (shape.rod)
      for (int e = 0; e < shape.rod->frames->count(); ++e) v(3 * shape.rod->frames->twists()[e]) = shape.rod->frames->radius() * spin.dot(shape.rod->frames->tangent(e, x));
    // Newmark: x' - x = h/2 (v + v'), a rotation by 2 atan(h/2 |spin|).
    const EndVelocity velocity{2 / h, x + h / 2 * v};
    auto damping = begun(elastic, x);
    damping->begin_step({x, 0, h, &velocity, &v});
    const Mat3 turn = Eigen::AngleAxisd(2 * std::atan(h / 2 * spin.norm()), spin.normalized()).toRotationMatrix();
    const VecX end = shape.moved(x, turn, Vec3::Zero());
    RandomMotions random(4);
    const double strained = damping->value(end + shape.positions(5e-4 * random.vectors(x.size())));
    CHECK(damping->value(end) <= 1e-9 * strained);
  });
}

TEST_CASE("damping of strain: derivatives, projections, and beta K of small strains", "[damping]") {
  for_each_energy([](Term& elastic, const DampedBody& shape) {
    RandomMotions random(7);
    const VecX x = *shape.rest + shape.positions(2e-4 * random.vectors(shape.rest->size()));
    const auto damping = begun(elastic, x);
    const VecX y = x + shape.positions(2e-4 * random.vectors(x.size()));
    const auto gradient = [&](const VecX& z) { return dense_gradient(*damping, z); };
    const VecX g = gradient(y), by_value = gradient_by_differences([&](const VecX& z) { return damping->value(z); }, y, 1e-6);
    CHECK((g - by_value).norm() <= 1e-6 * g.norm());
    const MatX exact = dense_hessian(*damping, y, Projection::none), differences = hessian_by_differences(gradient, y, 1e-6);
    // The Hessian of stencils of rank one holds the squares of their gradients only.
    bool rank_one = false;
    for (const StencilBatch& b : elastic.batches()) rank_one = rank_one || b.rank_one;
    CHECK((exact - differences).norm() <= (rank_one ? 0.05 : 1e-6) * exact.norm());
    for_each_stencil_hessian(*damping, y, Projection::clamp, [&](const MatX& stencil, const int*) { CHECK(smallest_eigenvalue(stencil) >= -1e-10 * stencil.norm()); });
    // From the unstressed rest shape.
    if (dense_gradient(elastic, *shape.rest).norm() > 1e-9 * g.norm()) return;  // but for a rod that wants to be straight
    const auto from_rest = begun(elastic, *shape.rest);
    const MatX k = dense_hessian(elastic, *shape.rest, Projection::none), c = dense_hessian(*from_rest, *shape.rest, Projection::none);
    CHECK((c - beta / h * k).norm() <= 1e-6 * c.norm());
  });
}
