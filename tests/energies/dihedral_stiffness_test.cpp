// Patch test of the dihedral edges of a sheet: moments and energies of constant curvatures, and the torque of a strip.
#include "energies/shell/dihedral_stiffness.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <set>

#include "framework/scene/energy.hpp"
#include "tests/support/component_variants.hpp"
#include "tests/support/dense_term.hpp"
#include "tests/support/sheet_body.hpp"
#include "tests/support/test_run.hpp"
#include "tests/support/tet_body.hpp"

using namespace tack;

namespace {

constexpr double thickness = 1e-3;

struct Named {
  std::string name;
  SheetBody sheet;
};

// Reverses every second and third diagonal of some cells.
SheetBody with_mixed_diagonals(SheetBody s) {
  RandomMotions random(7);
  for (size_t t = 0; t + 1 < s.body.sheet.size(); t += 2) {
    if (random.uniform(-1, 1) < 0) continue;
    Triangle &a = s.body.sheet[t], &b = s.body.sheet[t + 1];
    const std::set<int> of_a(a.begin(), a.end()), of_b(b.begin(), b.end());
    const auto alone = [](const Triangle& x, const std::set<int>& other) {
      int i = 0;
      while (other.count(x[i])) ++i;
      return i;
    };
    const int i = alone(a, of_b), k = alone(b, of_a);
    const int p = a[i], q = b[k], r = a[(i + 1) % 3], u = a[(i + 2) % 3];
    a = {p, r, q};
    b = {p, q, u};
  }
  s.body.triangles = s.body.sheet;
  return s;
}

std::vector<Named> sheets() {
  std::vector<Named> all;
  const Vec2 size(0.2, 0.08);
  const std::array<int, 2> cells = {30, 12};
  for (const Diagonals d : {Diagonals::uniform, Diagonals::alternating})
    for (const double jitter : {0.0, 0.2})
      all.push_back({fmt::format("{} {}", d == Diagonals::uniform ? "uniform" : "alternating", jitter), SheetBody(size, cells, thickness, jitter, d)});
  all.push_back({"alternating, long cells", SheetBody(size, {15, 12}, thickness, 0, Diagonals::alternating)});
  all.push_back({"mixed diagonals", with_mixed_diagonals(SheetBody(size, cells, thickness, 0))});
  all.push_back({"mixed diagonals, jitter", with_mixed_diagonals(SheetBody(size, cells, thickness, 0.2))});
  return all;
}

// Returns the angle of the dihedral edge from a to b of a sheet with the heights `up`, from its normals; positive where apexes rise.
double opened(const VecX& rest, const VecX& up, int a, int b, int left, int right) {
  const auto slope = [&](int apex) {
    const Vec3 along = vertex(rest, b) - vertex(rest, a), arm = vertex(rest, apex) - vertex(rest, a);
    const double foot = arm.dot(along) / along.squaredNorm(), height = along.cross(arm).norm() / along.norm();
    return (up(apex) - (1 - foot) * up(a) - foot * up(b)) / height;
  };
  return slope(left) + slope(right);
}

struct Curvature {
  std::string name;
  double xx, xz, zz;
};
const std::vector<Curvature> curvatures = {{"along x", 1, 0, 0}, {"along z", 0, 0, 1}, {"twist", 0, 1, 0}, {"bowl", 1, 0, 1}, {"mixed", 1, -0.7, 0.4}};

VecX heights(const SheetBody& s, const Curvature& k) {
  VecX up(s.body.vertex_count);
  for (int v = 0; v < s.body.vertex_count; ++v) {
    const Vec3 x = vertex(s.rest, v);
    up(v) = k.xx * x.x() * x.x() / 2 + k.xz * x.x() * x.z() + k.zz * x.z() * x.z() / 2;
  }
  return up;
}

}  // namespace

TEST_CASE("dihedral edges have the moments and the energy of a plate that is bent by a constant curvature", "[shells]") {
  for (const auto& [name, sheet] : sheets()) {
    const auto triangles = connect_sheet(sheet.body.sheet, "");
    std::set<int> border;  // vertices
    for (const SheetTriangle& t : triangles)
      for (int i = 0; i < 3; ++i)
        if (t.neighbour[i] < 0) border.insert({t.vertices[(i + 1) % 3], t.vertices[(i + 2) % 3]});
    for (const double poisson : {0.0, 0.3, 0.45}) {
      const FittedFans fitted = fit_dihedral_stiffness(triangles, sheet.rest, 1, poisson);
      CHECK(fitted.error < 0.01);
      for (const Curvature& k : curvatures) {
        INFO(name << ", nu " << poisson << ", " << k.name);
        const VecX up = heights(sheet, k);
        std::map<std::pair<int, int>, double> moment, angle, wanted;
        for (size_t f = 0; f < fitted.fans.size(); ++f) {
          const auto& [shape, v, own] = fitted.fans[f];
          Eigen::Matrix<double, fan_edges_max, 1> a = Eigen::Matrix<double, fan_edges_max, 1>::Zero();
          for (int i = 0; i < shape.edge_count; ++i) a(i) = opened(sheet.rest, up, v[0], v[shape.tip(i)], v[shape.left(i)], v[shape.right(i)]);
          const auto m = (fitted.c[f] * a).eval();
          for (int i = 0; i < shape.edge_count; ++i) {
            const int tip = v[shape.tip(i)];
            if (border.count(v[0]) + border.count(tip) + border.count(v[shape.left(i)]) + border.count(v[shape.right(i)]) > 0) continue;
            const std::pair<int, int> key = std::minmax(v[0], tip);
            const Vec3 t = vertex(sheet.rest, tip) - vertex(sheet.rest, v[0]);
            const double x = -t.z() / t.norm(), z = t.x() / t.norm();  // across
            const double nn = k.xx * x * x + 2 * k.xz * x * z + k.zz * z * z;
            moment[key] += m(i);
            angle[key] = a(i);
            wanted[key] = t.norm() * ((1 - poisson) * nn + poisson * (k.xx + k.zz));
          }
        }
        double energy = 0, exact = 0, off = 0, size = 0;
        for (const auto& [key, m] : moment) {
          energy += m * angle[key] / 2;
          exact += wanted[key] * angle[key] / 2;
          off += std::pow(m - wanted[key], 2);
          size += std::pow(wanted[key], 2);
        }
        CHECK(energy == Approx(exact).epsilon(0.005));
        CHECK(std::sqrt(off / size) < 0.02);
      }
    }
  }
}

TEST_CASE("a twisted sheet has the energy of a plate, and no force on inner vertices", "[shells]") {
  for (const auto& [name, sheet] : sheets()) {
    for (const double poisson : {0.0, 0.3, 0.45}) {
      INFO(name << ", nu " << poisson);
      const auto term = component<Energy>(fmt::format("{{type: hinge_bending, stiffness: 1, poisson: {}}}", poisson))->make_term(sheet.body, sheet.rest);
      const double twist = 1e-4;  // 1/m
      const VecX x = sheet.mapped([&](const Vec3& v) { return Vec3(v.x(), twist * v.x() * v.z(), v.z()); });
      CHECK(term->value(x) == Approx((1 - poisson) * twist * twist * 0.2 * 0.08).epsilon(0.005));
      const VecX gradient = dense_gradient(*term, x);
      // The forces at the corners are 2 M_xz.
      double largest = 0;
      for (int v = 0; v < sheet.body.vertex_count; ++v) {
        const Vec3 at = vertex(sheet.rest, v);
        const bool corner = std::abs(at.x()) > 0.0999 && std::abs(at.z()) > 0.0399;
        if (corner) CHECK(std::abs(gradient(3 * v + 1)) == Approx(2 * (1 - poisson) * twist).epsilon(0.02));
        else largest = std::max(largest, std::abs(gradient(3 * v + 1)));
      }
      CHECK(largest < 0.05 * 2 * (1 - poisson) * twist);
    }
  }
}

TEST_CASE("a strip that is twisted resists by G b t^3/3 per length on every grid", "[shells]") {
  constexpr double young = 1e8, length = 0.2, width = 0.04, angle = 1e-3;
  for (const auto& [cells, diagonals, jitter] :
       {std::tuple("[20, 4]", "alternating", 0.0), {"[40, 8]", "alternating", 0.0}, {"[20, 4]", "uniform", 0.0}, {"[30, 6]", "alternating", 0.2},
        {"[20, 4]", "alternating", 0.24}, {"[30, 6]", "uniform", 0.2}, {"[20, 8]", "alternating", 0.2}, {"[20, 1]", "alternating", 0.0}}) {
    for (const double poisson : {0.0, 0.3, 0.45}) {
      INFO(cells << " " << diagonals << " " << jitter << " nu " << poisson);
      TestRun run(fmt::format(
          "time: {{step: 1, duration: 1, integrator: quasi_static}}\nobjects:\n"
          "  - name: s\n    shape: {{type: grid, size: [{0}, {1}], cells: {2}, diagonals: {3}, jitter: {4}}}\n    shell: {{thickness: {5}}}\n"
          "    energies: [{{type: stvk_membrane, young: {6}, poisson: {7}}}, {{type: hinge_bending, young: {6}, poisson: {7}}}]\n"
          "    motion:\n      - {{type: fixed, select: {{type: face, direction: [-1, 0, 0]}}}}\n"
          "      - {{type: rotate, axis: [1, 0, 0], angle: {8}, duration: 1, across: [1, 0, 0], select: {{type: face, direction: [1, 0, 0]}}}}\n"
          "probes: [{{name: T, type: torque, object: s, direction: [1, 0, 0], select: {{type: face, direction: [1, 0, 0]}}}}]\n"
          "solver: {{type: projected_newton, force_tolerance: 1e-7}}\n",
          length, width, cells, diagonals, jitter, thickness, young, poisson, angle));
      run.step();
      const double shear = young / (2 * (1 + poisson));
      CHECK(run.sample(0)[0] == Approx(shear * width * std::pow(thickness, 3) / 3 * angle / length).epsilon(0.02));
    }
  }
}
