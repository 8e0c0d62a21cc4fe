// The clipped integral of plates, against closed forms: areas, boundary forces, edges that coincide.
#include <catch2/catch.hpp>
#include <Eigen/Geometry>
#include <random>

#include "tests/framework/contact/clipped/clipped_plates.hpp"

namespace tack {
namespace {

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

}  // namespace
}  // namespace tack
