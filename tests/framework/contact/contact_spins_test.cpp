// Rotations of rods and particles by friction: directions by which a rotation moves the contact
// point, against cross products.
#include "framework/contact/points/contact_spins.hpp"

#include <catch2/catch.hpp>
#include <stdexcept>

#include "tests/framework/contact/surface_builder.hpp"

using namespace tack;

namespace {

// Returns the motion of the contact point by values of the scalar dofs.
Vec3 motion(const ContactSpins::Columns& columns, const VecX& values) {
  Vec3 sum = Vec3::Zero();
  for (int i = 0; i < columns.count; ++i) sum += values[columns.scalar_dofs[i]] * columns.directions[i];
  return sum;
}

}  // namespace

TEST_CASE("a particle that turns by w moves its point of contact by R n x w", "[contact][spins]") {
  RandomPoints random(1);
  const double radius = 0.03, gyration = 0.02;
  ContactSpins spins(4);
  CHECK(spins.empty());
  spins.add_particle(2, {5, 6, 7}, radius / gyration);
  CHECK_FALSE(spins.empty());
  for (int trial = 0; trial < 20; ++trial) {
    const Vec3 n = random.direction(), w = random.point(1);
    ContactSpins::Columns columns;
    spins.append(std::array{2}, n, VecX::Zero(12), columns);
    CHECK(columns.count == 3);
    VecX arcs = VecX::Zero(8);
    arcs.tail<3>() = gyration * w;
    CHECK((motion(columns, arcs) - radius * n.cross(w)).norm() < 1e-15);
  }
  ContactSpins::Columns none;
  spins.append(std::array{1}, Vec3::UnitX(), VecX::Zero(12), none);
  CHECK(none.count == 0);
}

TEST_CASE("a rod that turns about its tangent moves its point of contact by R n x t, whichever end is named first", "[contact][spins]") {
  RandomPoints random(2);
  const double lever = 1.5;
  ContactSpins spins(3);
  spins.add_rod({0, 1}, 4, lever);
  for (int trial = 0; trial < 20; ++trial) {
    const Vec3 n = random.direction();
    VecX x(9);
    x << random.point(1), random.point(1), random.point(1);
    const Vec3 tangent = Vec3(vertex(x, 1) - vertex(x, 0)).normalized();
    for (const std::array<int, 2> edge : {std::array{0, 1}, std::array{1, 0}}) {
      ContactSpins::Columns columns;
      spins.append(edge, n, x, columns);
      REQUIRE(columns.count == 1);
      CHECK(columns.scalar_dofs[0] == 4);
      CHECK((columns.directions[0] - lever * n.cross(tangent)).norm() < 1e-14);
    }
    for (const int end : {0, 1}) {
      ContactSpins::Columns columns;
      spins.append(std::array{end}, n, x, columns);
      REQUIRE(columns.count == 1);
      CHECK((columns.directions[0] - lever * n.cross(tangent)).norm() < 1e-14);
    }
  }
}

TEST_CASE("a vertex between two edges has half of each rotation, so that equal rotations of both sum up to one", "[contact][spins]") {
  ContactSpins spins(3);
  spins.add_rod({0, 1}, 7, 2);
  spins.add_rod({1, 2}, 8, 2);
  VecX x(9);
  x << 0, 0, 0, 1, 0, 0, 2, 0, 0;
  ContactSpins::Columns columns;
  spins.append(std::array{1}, Vec3::UnitZ(), x, columns);
  CHECK(columns.count == 2);
  CHECK((motion(columns, VecX::Ones(9)) - 2 * Vec3::UnitZ().cross(Vec3::UnitX())).norm() < 1e-15);
}

TEST_CASE("vertices where more than two edges meet, and triangles, do not turn", "[contact][spins]") {
  ContactSpins spins(5);
  for (int i = 1; i < 4; ++i) spins.add_rod({0, i}, 4 + i, 1);
  VecX x(15);
  x << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 5, 5, 5;
  ContactSpins::Columns columns;
  spins.append(std::array{0}, Vec3(1, 1, 1).normalized(), x, columns);
  spins.append(std::array{0, 1, 2}, Vec3::UnitZ(), x, columns);
  CHECK(columns.count == 0);
}

TEST_CASE("columns of one scalar dof are summed, and more columns than the capacity are refused", "[contact][spins]") {
  ContactSpins::Columns columns;
  columns.add(3, Vec3::UnitX());
  columns.add(3, Vec3::UnitY());
  CHECK(columns.count == 1);
  CHECK(columns.directions[0] == Vec3(1, 1, 0));
  for (int i = 1; i < ContactSpins::Columns::capacity; ++i) columns.add(10 + i, Vec3::UnitX());
  CHECK_THROWS_AS(columns.add(99, Vec3::UnitX()), std::logic_error);
}
