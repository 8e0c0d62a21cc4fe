// The clipped integral of two triangles and of plates of them, against closed forms and finite
// differences.
#include "framework/contact/clipped/clipped_pair.hpp"

#include <catch2/catch.hpp>
#include <Eigen/Geometry>
#include <Eigen/Eigenvalues>
#include <random>
#include <tuple>

#include "framework/assembly/stencil_blocks.hpp"
#include "framework/contact/clipped/boundary_weight.hpp"
#include "framework/contact/clipped/clip_pack.hpp"

namespace tack {
namespace {

// Traction that rises linearly to `strength` at half of the range and falls to zero at the range.
class TentLaw final : public NormalLaw {
 public:
  TentLaw(double range, double work) : range_(range), strength_(2 * work / range) {}
  std::string_view name() const override { return "tent"; }
  void prepare(const PairMaterials&) override {}
  double range() const override { return range_; }
  void add_samples(int n, const double* d, LawSample* out) const override {
    const double peak = range_ / 2, slope = strength_ / peak, work = strength_ * peak;
    for (int i = 0; i < n; ++i) {
      if (d[i] >= range_) continue;
      if (d[i] < peak) {
        out[i].value += -work + slope * d[i] * d[i] / 2;
        out[i].slope += slope * d[i];
        out[i].curvature += slope;
      } else {
        out[i].value -= slope * (range_ - d[i]) * (range_ - d[i]) / 2;
        out[i].slope += slope * (range_ - d[i]);
        out[i].curvature -= slope;
      }
    }
  }
  void add_values(int n, const double* d, double* out) const override {
    for (int i = 0; i < n; ++i) {
      LawSample sample;
      add_samples(1, d + i, &sample);
      out[i] += sample.value;
    }
  }
  std::unique_ptr<NormalLaw> clone() const override { return std::make_unique<TentLaw>(*this); }

 private:
  double range_, strength_;
};

PairLaw tent_law() {
  PairLaw law;
  law.add(std::make_shared<TentLaw>(1.0, 1.0));
  return law;
}

// -(1 + 4 g) exp(-4 g) (1 - g)^3.
class SteepLaw final : public NormalLaw {
 public:
  std::string_view name() const override { return "steep"; }
  void prepare(const PairMaterials&) override {}
  double range() const override { return 1; }
  void add_samples(int n, const double* d, LawSample* out) const override {
    for (int i = 0; i < n; ++i) {
      if (d[i] >= 1) continue;
      const double e = std::exp(-4 * d[i]), f = -(1 + 4 * d[i]) * e, f1 = 16 * d[i] * e, f2 = 16 * (1 - 4 * d[i]) * e;
      const double c = std::pow(1 - d[i], 3), c1 = -3 * std::pow(1 - d[i], 2), c2 = 6 * (1 - d[i]);
      out[i].value += f * c;
      out[i].slope += f1 * c + f * c1;
      out[i].curvature += f2 * c + 2 * f1 * c1 + f * c2;
    }
  }
  void add_values(int n, const double* d, double* out) const override {
    for (int i = 0; i < n; ++i) out[i] += at(d[i]).value;
  }
  std::unique_ptr<NormalLaw> clone() const override { return std::make_unique<SteepLaw>(*this); }
};

PairLaw steep_law() {
  PairLaw law;
  law.add(std::make_shared<SteepLaw>());
  return law;
}

std::array<Vec3, 6> corners_of(const ClippedPair& pair) {
  return {pair.a[0], pair.a[1], pair.a[2], pair.b[0], pair.b[1], pair.b[2]};
}
void set_corners(ClippedPair& pair, const std::array<Vec3, 6>& x) {
  for (int k = 0; k < 3; ++k) {
    pair.a[k] = x[k];
    pair.b[k] = x[3 + k];
  }
}

double energy_at(ClipIntegrator& integrator, ClippedPair pair, const std::array<Vec3, 6>& x, const PairLaw& law,
                 const GapBands& bands) {
  set_corners(pair, x);
  return integrator.value(pair, law, bands).energy;
}

// A triangle b in the plane z = 0 seen from above, and a above it, facing down, both with noise.
ClippedPair random_pair(std::mt19937& random, double tilt) {
  std::uniform_real_distribution<double> u(-1, 1);
  ClippedPair pair;
  pair.b = {Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(0.5, 1.8, 0)};
  pair.a = {Vec3(0.2, 0.1, 0.4), Vec3(0.4, 1.6, 0.4), Vec3(1.9, 0.3, 0.4)};
  const Vec3 shift(u(random), u(random), 0.3 * u(random));
  for (int k = 0; k < 3; ++k) {
    pair.a[k] += shift + Vec3(0.3 * u(random), 0.3 * u(random), tilt * u(random));
    pair.b[k] += Vec3(0.2 * u(random), 0.2 * u(random), 0.5 * tilt * u(random));
  }
  return pair;
}

// A plate [x0, x0 + side] x [y0, y0 + side] at height z, cells x cells squares of two triangles.
struct Plate {
  std::vector<std::array<Vec3, 3>> triangles;
  std::vector<std::array<bool, 3>> boundary;
};
Plate plate(double x0, double y0, double z, double side, int cells, bool up) {
  Plate all;
  const double h = side / cells;
  const auto on_boundary = [&](const Vec3& p, const Vec3& q) {
    for (int d = 0; d < 2; ++d)
      for (const double at : {d == 0 ? x0 : y0, (d == 0 ? x0 : y0) + side})
        if (std::abs(p[d] - at) < 1e-9 && std::abs(q[d] - at) < 1e-9) return true;
    return false;
  };
  for (int i = 0; i < cells; ++i)
    for (int j = 0; j < cells; ++j) {
      const Vec3 p(x0 + i * h, y0 + j * h, z), px = p + Vec3(h, 0, 0), py = p + Vec3(0, h, 0), pxy = p + Vec3(h, h, 0);
      for (std::array<Vec3, 3> t : {std::array<Vec3, 3>{p, px, pxy}, std::array<Vec3, 3>{p, pxy, py}}) {
        if (!up) std::swap(t[1], t[2]);
        all.triangles.push_back(t);
        std::array<bool, 3> boundary;
        for (int k = 0; k < 3; ++k) boundary[k] = on_boundary(t[k], t[(k + 1) % 3]);
        all.boundary.push_back(boundary);
      }
    }
  return all;
}

struct PlatesResult {
  double energy = 0, area = 0;
  Vec3 force_on_a = Vec3::Zero();
};
PlatesResult between(const Plate& a, const Plate& b, double strip, const PairLaw& law) {
  ClipIntegrator integrator;
  const GapBands bands = gap_bands(law);
  PlatesResult all;
  for (std::size_t i = 0; i < a.triangles.size(); ++i)
    for (std::size_t j = 0; j < b.triangles.size(); ++j) {
      ClippedPair pair{a.triangles[i], b.triangles[j], a.boundary[i], {}};
      for (int k = 0; k < 3; ++k) {
        const Vec3 &from = pair.b[k], &to = pair.b[(k + 1) % 3];
        pair.owns_b[k] = std::tie(from.x(), from.y()) < std::tie(to.x(), to.y());
        pair.strip_b[k] = b.boundary[j][k] ? strip : 0;
      }
      Vec18 gradient;
      const ClippedIntegral one = integrator.derivatives(pair, law, bands, gradient, nullptr);
      all.energy += one.energy;
      for (int k = 0; k < 3; ++k) {
        all.area += one.area[k];
        all.force_on_a -= gradient.segment<3>(3 * k);
      }
    }
  return all;
}

TEST_CASE("the gradient of a clipped pair is that of its energy", "[clipped]") {
  std::mt19937 random(7);
  ClipIntegrator integrator;
  const PairLaw tent = tent_law(), steep = steep_law();
  int compared = 0;
  for (int trial = 0; trial < 400; ++trial) {
    ClippedPair pair = random_pair(random, trial % 4 == 0 ? 1.5 : 0.2);
    if (trial % 2) pair.strip_b = {0.25, 0, trial % 3 ? 0.25 : 0};
    Vec18 gradient;
    const PairLaw& law = trial % 3 == 2 ? steep : tent;
    const GapBands bands = gap_bands(law);
    if (integrator.derivatives(pair, law, bands, gradient, nullptr).energy == 0) continue;
    ++compared;
    std::array<Vec3, 6> x = corners_of(pair);
    for (int i = 0; i < 18; ++i) {
      // Fourth-order differences.
      constexpr double h = 1e-5;
      const auto at = [&](double step) {
        std::array<Vec3, 6> moved = x;
        moved[i / 3][i % 3] += step;
        return energy_at(integrator, pair, moved, law, bands);
      };
      const double difference = (8 * (at(h) - at(-h)) - (at(2 * h) - at(-2 * h))) / (12 * h);
      INFO("trial " << trial << ", variable " << i);
      CHECK(gradient[i] == Approx(difference).margin(2e-7));
    }
  }
  CHECK(compared > 200);
}

TEST_CASE("a clipped pair has no net force and no net moment", "[clipped]") {
  std::mt19937 random(8);
  ClipIntegrator integrator;
  const PairLaw law = tent_law();
  const GapBands bands = gap_bands(law);
  for (int trial = 0; trial < 200; ++trial) {
    ClippedPair pair = random_pair(random, 0.5);
    pair.strip_b = {0.25, 0.25, 0};
    Vec18 gradient;
    integrator.derivatives(pair, law, bands, gradient, nullptr);
    const std::array<Vec3, 6> x = corners_of(pair);
    Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
    for (int k = 0; k < 6; ++k) {
      force += gradient.segment<3>(3 * k);
      moment += x[k].cross(gradient.segment<3>(3 * k));
    }
    CHECK(force.norm() < 1e-12);
    CHECK(moment.norm() < 1e-11);
  }
}

TEST_CASE("the Hessian of a clipped pair is symmetric and positive semi-definite", "[clipped]") {
  std::mt19937 random(9);
  ClipIntegrator integrator;
  const PairLaw law = tent_law();
  const GapBands bands = gap_bands(law);
  double largest = 0;
  for (int trial = 0; trial < 100; ++trial) {
    ClippedPair pair = random_pair(random, 0.3);
    pair.strip_b = {0.25, 0.25, 0.25};
    pair.boundary_a = {true, true, false};
    Vec18 gradient;
    Mat18 hessian;
    integrator.derivatives(pair, law, bands, gradient, &hessian);
    CHECK((hessian - hessian.transpose()).norm() <= 1e-12 * hessian.norm());
    const Vec18 values = Eigen::SelfAdjointEigenSolver<Mat18>(hessian).eigenvalues();
    CHECK(values.minCoeff() >= -1e-12 * std::max(1.0, values.maxCoeff()));
    largest = std::max(largest, values.maxCoeff());
  }
  CHECK(largest > 0.1);
}

TEST_CASE("packs of pairs give what pairs give one by one", "[clipped]") {
  std::mt19937 random(10);
  ClipIntegrator integrator;
  const PairLaw law = tent_law();
  const GapBands bands = gap_bands(law);
  int found = 0, empty = 0;
  for (int trial = 0; trial < 400; ++trial) {
    ClipPack pack;
    std::array<ClippedPair, pack_width> pairs;
    for (int l = 0; l < pack_width; ++l) {
      pairs[l] = random_pair(random, l % 4 == 3 ? 1.5 : l % 4 == 2 ? 0 : 0.05);
      if (l % 2) pairs[l].strip_b = {l % 3 == 0 ? 0.25 : 0, l % 3 == 1 ? 0.25 : 0, l % 3 == 2 ? 0.25 : 0};
      pairs[l].boundary_a = {trial % 2 == 0, trial % 3 == 0, trial % 5 == 0};
      VecX x(18);
      for (int k = 0; k < 6; ++k) vertex(x, k) = k < 3 ? pairs[l].a[k] : pairs[l].b[k - 3];
      pack.set(l, x, {0, 1, 2, 3, 4, 5}, pairs[l].strip_b, pairs[l].boundary_a);
    }
    const unsigned plain = pack.clip(bands);
    std::array<double, 2 * pack_width> values;
    std::array<LawSample, 2 * pack_width> samples;
    law.values(2 * pack_width, pack.gaps(), values.data());
    law.samples(2 * pack_width, pack.gaps(), samples.data());
    const Pack energy = pack.energy(values.data());
    std::array<Pack, 18> gradient;
    std::array<Pack, ClipPack::hessian_slots> hessian;
    pack.derivatives(samples.data(), gradient.data(), hessian.data());
    for (int l = 0; l < pack_width; ++l) {
      if ((plain >> l & 1u) == 0) continue;
      INFO("trial " << trial << ", lane " << l);
      Vec18 g;
      Mat18 h;
      const double e = integrator.derivatives(pairs[l], law, bands, g, &h).energy;
      ++(e == 0 ? empty : found);
      CHECK(energy[l] == Approx(e).margin(1e-13));
      std::array<double, ClipPack::hessian_slots> blocks;
      store_blocks<6>(h, blocks.data());
      for (int i = 0; i < 18; ++i) REQUIRE(gradient[i][l] == Approx(g[i]).margin(1e-12));
      for (int i = 0; i < ClipPack::hessian_slots; ++i) REQUIRE(hessian[i][l] == Approx(blocks[i]).margin(1e-12));
    }
  }
  CHECK(found > 500);
  CHECK(empty > 50);
}

TEST_CASE("a gap that is even up to round-off may lie at a level", "[clipped]") {
  // A law that no parabola fits: the force of a level is not zero, and is divided by the slope of the
  // gap.
  const PairLaw law = steep_law();
  const GapBands bands = gap_bands(law);
  std::mt19937 random(12);
  std::uniform_real_distribution<double> u(-1, 1);
  ClipIntegrator integrator;
  for (const double spread : {0.0, 1e-17, 1e-16, 1e-15, 1e-14, 1e-12, 1e-9, 1e-6}) {
    INFO("spread " << spread);
    for (int trial = 0; trial < 100; ++trial) {
      const double level = bands[1 + trial % (bands.size() - 2)];
      ClippedPair pair = random_pair(random, 0);
      pair.b = {Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(0.5, 1.8, 0)};
      ClippedPair below = pair;
      for (int k = 0; k < 3; ++k) {
        pair.a[k].z() = level + spread * u(random);
        below.a[k].z() = (1 - 1e-3) * level;
      }
      Vec18 gradient, expected;
      integrator.derivatives(pair, law, bands, gradient, nullptr);
      integrator.derivatives(below, law, bands, expected, nullptr);
      // Of gradients up to 2.
      CHECK((gradient - expected).cwiseAbs().maxCoeff() < 0.01);
    }
  }
}

TEST_CASE("plates adhere by the area of their overlap, whatever their meshes", "[clipped]") {
  const PairLaw law = tent_law();
  for (const double gap : {0.1, 0.5, 0.9})
    for (const auto& [cells_a, cells_b] : {std::pair{1, 1}, {3, 2}, {7, 5}})
      for (const Vec2& shift : {Vec2(0, 0), Vec2(0.3, 0), Vec2(1.7, 2.9)}) {
        INFO("gap " << gap << ", " << cells_a << " and " << cells_b << " cells, shifted by " << shift.transpose());
        const Plate a = plate(shift.x(), shift.y(), gap, 10, cells_a, false), b = plate(0, 0, 0, 10, cells_b, true);
        const double overlap = (10 - shift.x()) * (10 - shift.y());
        const LawSample sample = law.at(gap);
        const PlatesResult sharp = between(a, b, 0, law);
        CHECK(sharp.area == Approx(overlap).epsilon(1e-7));
        CHECK(sharp.energy == Approx(overlap * sample.value).epsilon(1e-7));
        CHECK(sharp.force_on_a.z() == Approx(-overlap * sample.slope).epsilon(1e-7));
        // The strip keeps the area where the plate's boundary lies beyond it.
        const PlatesResult soft = between(a, b, 0.25, law);
        const double cut_short = shift.norm() > 0 && shift.maxCoeff() < 0.25 ? 1 : 1e-4;
        CHECK(soft.area == Approx(overlap).epsilon(cut_short));
      }
}

TEST_CASE("the boundary force of plates is the work of adhesion per length", "[clipped]") {
  const PairLaw law = tent_law();
  for (const double strip : {0.0, 0.25})
    for (const double shift : {0.4, 1.3, 2.77}) {
      const Plate a = plate(shift, 1, 0.2, 8, 5, false), b = plate(0, 0, 0, 10, 3, true);
      // The plate a reaches beyond b only if shift > 2.
      const Vec3 force = between(a, b, strip, law).force_on_a;
      INFO("strip " << strip << ", shift " << shift);
      CHECK(force.x() == Approx(shift > 2 ? 8 * law.at(0.2).value : 0.0).epsilon(1e-6).margin(1e-9));
      CHECK(force.y() == Approx(0).margin(1e-8));
    }
}

TEST_CASE("a boundary along lines of the other mesh has the whole boundary force", "[clipped]") {
  const PairLaw law = tent_law();
  // Round-off decides nothing: shifts by less than the tolerance of ties change hardly anything.
  for (const double noise : {0.0, 1e-17, -1e-17, 1e-12, -1e-12, 4e-9, -4e-9, 1e-6, -1e-6}) {
    const Plate a = plate(5 + noise, 2.5, 0.2, 10, 4, false), b = plate(0, 0, 0, 10, 4, true);
    INFO("shifted by " << noise << " more than two cells");
    const PlatesResult both = between(a, b, 0.25, law);
    CHECK(both.energy == Approx((5 - noise) * 7.5 * law.at(0.2).value).epsilon(1e-4));
    CHECK(both.force_on_a.x() == Approx(7.5 * law.at(0.2).value).epsilon(1e-4));
    CHECK(both.force_on_a.y() == Approx(5 * law.at(0.2).value).epsilon(1e-4));
  }
}

TEST_CASE("an edge along a crease of the other surface has no boundary force", "[clipped]") {
  // Both sides of a crease see the edge at distances that do not add up to zero: by 4e-9 here.
  const PairLaw law = tent_law();
  Plate b = plate(0, 0, 0, 10, 4, true);
  for (std::array<Vec3, 3>& triangle : b.triangles)
    for (Vec3& corner : triangle) corner.z() += 1e-8 * std::abs(corner.x() - 5);
  const double energy = between(plate(1, 1, 0.2, 8, 4, false), b, 0.25, law).energy;
  for (int i = -12; i <= 12; ++i) {
    const double shift = i * 1e-9;
    INFO("shifted by " << shift);
    const PlatesResult at = between(plate(1 + shift, 1, 0.2, 8, 4, false), b, 0.25, law);
    // The work of adhesion times the length is 7.4.
    CHECK(std::abs(at.force_on_a.x()) < 1e-6);
    CHECK(std::abs(at.energy - energy) < 2e-13 * std::abs(energy));
  }
}

TEST_CASE("an edge along a line of the other surface has the same force there and beside it", "[clipped]") {
  const PairLaw law = tent_law();
  const Plate b = plate(0, 0, 0, 10, 4, true);
  // bend: of lines of a, which then cross those of b several times.
  const auto tilted = [&](double shift, double bend) {
    Plate a = plate(1, 1, 0.05, 8, 4, false);
    for (std::array<Vec3, 3>& triangle : a.triangles)
      for (Vec3& corner : triangle) {
        corner.z() += 0.1 * (corner.y() - 1);
        corner.x() += shift + bend * std::sin(3 * corner.y());
      }
    return between(a, b, 0.25, law);
  };
  const PlatesResult beside = tilted(1e-6, 0);
  for (const auto& [shift, bend] : {std::pair{0.0, 0.0}, {1e-17, 0.0}, {-1e-9, 0.0}, {-1e-6, 0.0}, {0.0, 1e-15}, {0.0, 1e-12}, {1e-10, 1e-9}}) {
    INFO("shifted by " << shift << ", bent by " << bend);
    const PlatesResult at = tilted(shift, bend);
    CHECK((at.force_on_a - beside.force_on_a).norm() < 1e-8 * beside.force_on_a.norm());
    CHECK(at.energy == Approx(beside.energy).epsilon(1e-10));
  }
}

TEST_CASE("plates that lie exactly on each other do not push each other sideways", "[clipped]") {
  const PairLaw law = tent_law();
  const auto moved = [](Plate all, const Mat3& rotation, const Vec3& shift) {
    for (std::array<Vec3, 3>& triangle : all.triangles)
      for (Vec3& corner : triangle) corner = rotation * corner + shift;
    return all;
  };
  // In any other frame than the first, round-off acts on coordinates.
  for (const double angle : {0.0, 0.3, 1.1, 2.5})
    for (const double far : {0.0, 0.1234567, -77.7})
      for (const auto& [cells_a, cells_b] : {std::pair{1, 1}, {4, 4}, {4, 5}, {2, 9}}) {
        INFO(cells_a << " and " << cells_b << " cells, turned by " << angle << ", shifted by " << far);
        const Mat3 rotation = Eigen::AngleAxisd(angle, Vec3(1, -2, 0.7).normalized()).toRotationMatrix();
        const Vec3 shift = far * Vec3(1, 2, -0.4), normal = rotation.col(2);
        const Vec3 force = between(moved(plate(0, 0, 0.2, 10, cells_a, false), rotation, shift),
                                   moved(plate(0, 0, 0, 10, cells_b, true), rotation, shift), 0.25, law).force_on_a;
        CHECK((force - force.dot(normal) * normal).norm() < 1e-6);
      }
}

TEST_CASE("the energy has no jumps where edges come to coincide", "[clipped]") {
  const PairLaw law = tent_law();
  const Plate b = plate(0, 0, 0, 10, 4, true);
  const double slope = -7.5 * law.at(0.2).value;
  double last = 0;
  for (int i = 0; i <= 40; ++i) {
    const double shift = 5 + (i - 20) * 2.5e-9;
    const double energy = between(plate(shift, 2.5, 0.2, 10, 4, false), b, 0.25, law).energy;
    if (i > 0) CHECK(energy - last == Approx(slope * 2.5e-9).margin(1e-11));
    last = energy;
  }
}

TEST_CASE("the energy has no jumps where corners come to coincide", "[clipped]") {
  const PairLaw law = tent_law();
  const Plate b = plate(0, 0, 0, 10, 2, true);
  // Moves along a diagonal through exact alignment; differences of the second order are those of a
  // smooth function.
  const auto energy = [&](double shift) { return between(plate(shift, 0.7 * shift, 0.2, 10, 3, false), b, 0.25, law).energy; };
  for (const double at : {-3e-7, -4e-8, -1e-9, 0.0, 1e-9, 4e-8, 3e-7})
    for (const double step : {1e-12, 1e-9, 3e-8}) {
      INFO("at " << at << ", step " << step);
      CHECK(std::abs(energy(at + step) - energy(at)) < 1e-11 + 100 * step * (std::abs(at) + step) / 0.25);
    }
}

TEST_CASE("edges that coincide give no large gradients", "[clipped]") {
  const PairLaw law = tent_law();
  ClipIntegrator integrator;
  const GapBands bands = gap_bands(law);
  const Plate a = plate(0, 0, 0.3, 10, 4, false), b = plate(0, 0, 0, 10, 4, true);
  for (const auto& ta : a.triangles)
    for (const auto& tb : b.triangles) {
      Vec18 gradient;
      integrator.derivatives({ta, tb, {}, {}}, law, bands, gradient, nullptr);
      CHECK(gradient.cwiseAbs().maxCoeff() < 20);
    }
}

TEST_CASE("the boundary weight keeps area and its first moment", "[clipped]") {
  double zeroth = 0, first = 0;
  constexpr int points = 2000;
  for (int i = 0; i < points; ++i) {
    const double t = (i + 0.5) / points;
    zeroth += (1 - BoundaryWeight::at(t).value) / points;
    first += t * (1 - BoundaryWeight::at(t).value) / points;
  }
  CHECK(std::abs(zeroth) < 1e-6);
  CHECK(std::abs(first) < 1e-6);
  CHECK(BoundaryWeight::at(0).value == 0);
  CHECK(BoundaryWeight::at(1).value == 1);
  CHECK(BoundaryWeight::at(1 - 1e-12).slope == Approx(0).margin(1e-9));
}

}  // namespace
}  // namespace tack
