#include <catch2/catch.hpp>
#include <cstdint>

#include "framework/contact/gcp/smooth_steps.hpp"
#include "geometry/errors.hpp"
#include "tests/framework/contact/gcp/gcp_scene.hpp"

using namespace tack;

namespace {

// Two boxes askew over each other and a sheet below, all vertices displaced at random.
SurfaceBuilder cluster(unsigned seed) {
  SurfaceBuilder builder;
  RandomPoints random(seed);
  add_fine_box(builder, {0, 0, 0}, 0.1, 2, 0, Mat3::Identity());
  add_fine_box(builder, {0.02, 0.01, 0.115}, 0.1, 2, 1, Eigen::AngleAxisd(0.5, Vec3(0.1, 0.05, 1).normalized()).toRotationMatrix());
  builder.add_grid({3, 3}, 2, [](double u, double v) { return Vec3(0.12 * u - 0.1, 0.12 * v - 0.05, -0.058 - 0.01 * std::cos(6 * u)); }, true);
  return builder;
}

VecX shaken(const VecX& x, unsigned seed, double size) {
  RandomPoints random(seed);
  VecX y = x;
  for (int v = 0; v < x.size() / 3; ++v) vertex(y, v) += random.point(size);
  return y;
}

const std::vector<GcpSmoothing> smoothings = {{}, {.alpha_t = 1, .alpha_n = 0.9}, {.alpha_t = 0.8, .beta_t = -0.2, .alpha_n = 0.5, .beta_n = -0.1, .mollifier_width = 0.3}};

}  // namespace

TEST_CASE("gcp: smooth steps have their derivatives and ends", "[gcp]") {
  for (const auto& ends : {std::pair{0.5, 0.0}, {0.1, 0.0}, {0.9, -0.3}, {1.0, 0.0}}) {
    const double alpha = ends.first, beta = ends.second;
    CHECK(smooth_heaviside(-alpha, alpha, beta).value == 0);
    CHECK(smooth_heaviside(beta, alpha, beta).value == 1);
    CHECK(smooth_heaviside(0.5 * (beta - alpha), alpha, beta).value == Approx(0.5));
    for (double z = -alpha + 0.01; z < beta; z += 0.0173) {
      const SmoothStep h = smooth_heaviside(z, alpha, beta);
      CHECK(std::abs(central_difference([&](double e) { return smooth_heaviside(z + e, alpha, beta).value; }, 1e-5) - h.slope) < 1e-7);
      CHECK(std::abs(central_difference([&](double e) { return smooth_heaviside(z + e, alpha, beta).slope; }, 1e-6) - h.curvature) < 1e-2);
    }
    for (int i = 0; i <= 3; ++i) {
      const double knot = -alpha + i * (alpha + beta) / 3;
      const SmoothStep low = smooth_heaviside(knot - 1e-9, alpha, beta), high = smooth_heaviside(knot + 1e-9, alpha, beta);
      CHECK(std::abs(low.value - high.value) < 1e-6);
      CHECK(std::abs(low.slope - high.slope) < 1e-4);
      CHECK(std::abs(low.curvature - high.curvature) < 1e-4);
    }
  }
}

TEST_CASE("gcp: gradient and Hessian are those of the value", "[gcp]") {
  int kinds[4] = {}, tangents = 0, exteriors = 0, mollified = 0, largest = 0;
  for (size_t i = 0; i < smoothings.size(); ++i) {
    const unsigned seed = std::array{1, 2, 4}[i];
    const SurfaceBuilder builder = cluster(seed);
    GcpScene scene(builder, 0.04, smoothings[i]);
    const VecX x = shaken(builder.x(), seed, 2e-3), gradient = scene.gradient(x);
    for (int k = 0; k < 4; ++k) kinds[k] += scene.count(static_cast<GcpKind>(k));
    tangents += scene.count(GcpFactor::Type::tangent);
    exteriors += scene.count(GcpFactor::Type::exterior);
    mollified += scene.mollified(x);
    largest = std::max<int>(largest, scene.contacts.stencils().stencils.back().arity);
    const MatX hessian = dense_hessian(scene.term, x, Projection::none);
    const VecX slopes = gradient_by_differences([&](const VecX& y) { return scene.value(y); }, x, 1e-7);
    const MatX curvatures = hessian_by_differences([&](const VecX& y) { return scene.gradient(y); }, x, 1e-7);
    CHECK((slopes - gradient).lpNorm<Eigen::Infinity>() <= 1e-7 * gradient.lpNorm<Eigen::Infinity>());
    CHECK((curvatures - hessian).cwiseAbs().maxCoeff() <= 1e-6 * hessian.cwiseAbs().maxCoeff());
  }
  INFO(kinds[0] << ' ' << kinds[1] << ' ' << kinds[2] << ' ' << kinds[3] << " tangents " << tangents << " exteriors " << exteriors
                << " mollified " << mollified << " arity " << largest);
  for (const int n : kinds) CHECK(n > 10);
  CHECK(tangents > 100);
  CHECK(exteriors > 5);
  CHECK(mollified > 20);
  CHECK(largest > 10);
}

TEST_CASE("gcp: derivatives of stencils with factors of all types, at random positions", "[gcp]") {
  using enum GcpFactor::Type;
  const GcpSmoothing smoothing{.alpha_t = 1, .alpha_n = 1, .mollifier_width = 0.5};
  const LogBarrier barrier(1e4, 3);
  RandomPoints random(9);
  for (const GcpKind kind : {GcpKind::vertex_vertex, GcpKind::vertex_edge, GcpKind::vertex_face, GcpKind::edge_edge})
    for (const int primitive : {0, 1}) {
      if (kind == GcpKind::vertex_face && primitive == 1) continue;
      const auto core = static_cast<unsigned char>(gcp_core_count(kind));
      const bool edge = kind == GcpKind::edge_edge || (kind == GcpKind::vertex_edge && primitive == 1);
      const auto of = static_cast<unsigned char>(primitive), a = core, b = static_cast<unsigned char>(core + 1), c = static_cast<unsigned char>(core + 2);
      const std::vector<GcpFactor> factors = {{tangent, of, a, 0}, {tangent, of, b, 0}, {exterior, of, a, edge ? std::uint8_t(1) : b}, {exterior, of, b, edge ? std::uint8_t(0) : c}};
      const GcpStencil s{kind, static_cast<unsigned char>(core + 3), 0, 0.3, 0, 1, {0, 0}, 0, 0, 4};
      const auto positions = [&](const VecX& y) {
        GcpPositions p;
        for (int k = 0; k < s.arity; ++k) p[k] = y.segment<3>(3 * k);
        return p;
      };
      const auto derivatives = [&](const VecX& y, GcpHessian* h) {
        const GcpPositions p = positions(y);
        GcpGradient g;
        gcp_derivatives(s, factors, smoothing, p, barrier.at(gcp_distance(kind, p)), g, h);
        return VecX(g);
      };
      const auto energy = [&](const VecX& y) {
        const GcpPositions p = positions(y);
        return s.weight * barrier.at(gcp_distance(kind, p)).value * gcp_direction(s, factors, smoothing, p);
      };
      int found = 0;
      for (int trial = 0; trial < 100000 && found < 5; ++trial) {
        VecX y(3 * s.arity);
        for (int k = 0; k < s.arity; ++k) y.segment<3>(3 * k) = random.point(1);
        const GcpPositions p = positions(y);
        double sum = 0;
        for (const GcpFactor& f : factors)
          if (f.type == exterior) sum += smooth_heaviside(gcp_cosine(kind, f, p), 1, 0).value;
        if (!(sum > 0.2 && sum < 0.9) || gcp_direction(s, factors, smoothing, p) < 1e-2 || gcp_distance(kind, p) < 0.2) continue;
        ++found;
        GcpHessian hessian;
        const VecX gradient = derivatives(y, &hessian);
        const VecX slopes = gradient_by_differences(energy, y, 1e-6);
        const MatX curvatures = hessian_by_differences([&](const VecX& z) { return derivatives(z, nullptr); }, y, 1e-6);
        CHECK((slopes - gradient).lpNorm<Eigen::Infinity>() <= 1e-7 * gradient.lpNorm<Eigen::Infinity>());
        CHECK((curvatures - hessian).cwiseAbs().maxCoeff() <= 1e-7 * hessian.cwiseAbs().maxCoeff());
      }
      CHECK(found == 5);
    }
}

TEST_CASE("gcp: projected stencils are positive semi-definite", "[gcp]") {
  const SurfaceBuilder builder = cluster(1);
  GcpScene scene(builder, 0.04, smoothings[1]);
  const VecX x = shaken(builder.x(), 1, 2e-3);
  scene.move_to(x);
  const MatX exact = dense_hessian(scene.term, x, Projection::none);
  CHECK(smallest_eigenvalue(exact) < -1e-3 * exact.cwiseAbs().maxCoeff());
  for (const Projection projection : {Projection::clamp, Projection::absolute}) {
    for_each_stencil_hessian(scene.term, x, projection, [](const MatX& h, const int*) {
      REQUIRE(smallest_eigenvalue(h) >= -1e-12 * h.cwiseAbs().maxCoeff());
    });
    const MatX lifted = dense_hessian(scene.term, x, projection) - exact;
    CHECK(smallest_eigenvalue(lifted) >= -1e-10 * exact.cwiseAbs().maxCoeff());
  }
}

TEST_CASE("gcp: forces and moments add up to zero, and energies of stencils to the value", "[gcp]") {
  const SurfaceBuilder builder = cluster(2);
  for (const GcpSmoothing& smoothing : smoothings) {
    GcpScene scene(builder, 0.04, smoothing);
    const VecX x = shaken(builder.x(), 2, 2e-3), force = scene.forces(x);
    const double scale = force.cwiseAbs().sum();
    CHECK(scale > 0);
    CHECK(total(force).norm() <= 1e-12 * scale);
    CHECK(total_moment(x, force).norm() <= 1e-12 * scale);
    CHECK((force + dense_gradient(scene.term, x)).norm() <= 1e-12 * scale);
    double sum = 0;
    scene.term.visit_energies(x, [&](std::span<const int>, double joules) { sum += joules; });
    CHECK(sum == Approx(scene.term.value(x)));
    VecX pairs = VecX::Zero(force.size());
    for (int a = 0; a < 3; ++a)
      for (int b = a; b < 3; ++b) pairs += scene.term.forces(x, ObjectPair{a, b});
    CHECK((pairs - force).norm() <= 1e-12 * scale);
    CHECK((scene.term.force_between(x, {0, 1}) + scene.term.force_between(x, {1, 0})).norm() <= 1e-12 * scale);
  }
}

TEST_CASE("gcp: stencils without a free vertex are left out", "[gcp]") {
  const SurfaceBuilder builder = cluster(3);
  GcpScene scene(builder, 0.04);
  scene.move_to(builder.x());
  const size_t all = scene.contacts.stencils().stencils.size();
  std::vector<char> free(builder.x().size() / 3, 0);
  scene.contacts.set_free(free);
  scene.move_to(builder.x());
  CHECK(scene.contacts.stencils().stencils.empty());
  std::fill(free.begin(), free.end(), 1);
  scene.contacts.set_free(free);
  scene.move_to(builder.x());
  CHECK(scene.contacts.stencils().stencils.size() == all);
}

TEST_CASE("gcp: vertices with many neighbours are refused", "[gcp]") {
  for (const int n : {gcp_valence_max, gcp_valence_max + 1}) {
    SurfaceBuilder fan;
    const int apex = fan.add_vertex({0, 0, 0}, 0);
    for (int i = 0; i < n; ++i) fan.add_vertex({std::cos(2 * M_PI * i / n), std::sin(2 * M_PI * i / n), 0}, 0);
    for (int i = 0; i < n; ++i) fan.add_triangle({apex, apex + 1 + i, apex + 1 + (i + 1) % n}, true);
    if (n <= gcp_valence_max) CHECK_NOTHROW(GcpScene(fan, 0.01));
    else CHECK_THROWS_AS(GcpScene(fan, 0.01), InputError);
  }
}
