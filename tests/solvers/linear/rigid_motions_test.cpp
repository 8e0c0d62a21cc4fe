// Aggregates of bodies and their rigid motions as a coarse space, alone and in conjugate gradients.
#include "solvers/linear/rigid_motions.hpp"

#include <catch2/catch.hpp>
#include <tbb/global_control.h>

#include "framework/core/linear_solver.hpp"
#include "tests/support/component_variants.hpp"
#include "tests/support/linear_solve.hpp"
#include "tests/support/spring_lattice.hpp"
#include "tests/support/tet_body.hpp"

using namespace tack;

namespace {

// A solid that carries a sheet and a rod of a thousandth of its stiffness, all free; they touch by springs of a thousand times it.
BlockMatrix solid_sheet_and_rod(double mass = 1e-6) {
  const std::vector<SpringLattice> bodies{{{14, 14, 14}, 1, mass, Vec3::Zero()},
                                          {{60, 50, 1}, 1e-3, mass, Vec3(0, 0, 14)},
                                          {{200, 1, 1}, 1e-3, mass, Vec3(0, 0, 15)},
                                          {{2, 2, 2}, 1, mass, Vec3(0, 0, -2)}};
  std::vector<SpringContact> contacts;
  const int sheet = 14 * 14 * 14, rod = sheet + 60 * 50;
  for (int i = 0; i < 14; ++i) {
    for (int j = 0; j < 14; ++j) contacts.push_back({(i * 14 + j) * 14 + 13, sheet + i * 50 + j, 1e3, Vec3::UnitZ()});
    contacts.push_back({sheet + i * 50, rod + i, 1e3, Vec3::UnitZ()});
  }
  return spring_lattices(bodies, contacts);
}

}  // namespace

TEST_CASE("bodies are divided into aggregates, sheets and rods into small ones", "[linear]") {
  const BlockMatrix matrix = solid_sheet_and_rod();
  Aggregates pieces;
  pieces.build(matrix);
  std::vector<int> seen(matrix.columns(), 0);
  for (int a = 0; a < pieces.count(); ++a) {
    const int size = pieces.start[a + 1] - pieces.start[a], part = matrix.component[pieces.column[pieces.start[a]]];
    CHECK(size >= 6);
    CHECK(size <= (part == 0 ? 400 : 40));
    for (int i = pieces.start[a]; i < pieces.start[a + 1]; ++i) {
      ++seen[pieces.column[i]];
      CHECK(pieces.of[pieces.column[i]] == a);
      CHECK(matrix.component[pieces.column[i]] == part);
    }
  }
  for (int c = 0; c < matrix.columns(); ++c) CHECK(seen[c] == (matrix.component[c] == 3 ? 0 : 1));  // a body of 8 vertices is too small
  const int of_solid = *std::max_element(pieces.of.begin(), pieces.of.begin() + 14 * 14 * 14) + 1;
  CHECK(of_solid >= 8);
  CHECK(of_solid <= 30);
}

TEST_CASE("forces of rigid motions of aggregates give back the motions", "[linear]") {
  const BlockMatrix matrix = solid_sheet_and_rod();
  Aggregates pieces;
  pieces.build(matrix);
  RandomMotions random(1);
  VecX motion = VecX::Zero(matrix.size()), forces, found = VecX::Zero(matrix.size());
  for (int a = 0; a < pieces.count(); ++a) {
    const Vec3 shift = random.vectors(3), turn = random.vectors(3);
    for (int i = pieces.start[a]; i < pieces.start[a + 1]; ++i)
      motion.segment<3>(3 * pieces.column[i]) = shift + turn.cross(Vec3(matrix.positions.segment<3>(3 * pieces.column[i])));
  }
  matrix.multiply(motion, forces);
  RigidMotions rigid;
  REQUIRE(rigid.update(matrix));
  rigid.add(forces, found);
  CHECK((found - motion).norm() < 1e-4 * motion.norm());  // up to the shift that keeps factors of free bodies definite
  rigid.add(forces, found);
  CHECK((found - 2 * motion).norm() < 2e-4 * motion.norm());
}

TEST_CASE("rigid motions follow bodies and their matrices", "[linear]") {
  RigidMotions kept;
  for (const double mass : {1e-6, 1e-2, 1e2}) {
    BlockMatrix matrix = solid_sheet_and_rod(mass);
    RandomMotions random(2);
    const VecX b = random.vectors(matrix.size());
    const auto added = [&](RigidMotions& rigid) {
      VecX z = VecX::Zero(b.size());
      REQUIRE(rigid.update(matrix));
      rigid.add(b, z);
      return z;
    };
    RigidMotions fresh;
    CHECK((added(kept) == added(fresh)));
    matrix.values[0] *= 2;  // equal pattern
    CHECK((added(kept) == added(fresh)));
  }
}

TEST_CASE("without positions, large components, or a definite matrix there are no rigid motions", "[linear]") {
  const BlockMatrix whole = solid_sheet_and_rod();
  RigidMotions rigid;
  CHECK(rigid.update(whole));
  BlockMatrix matrix = whole;
  matrix.positions.resize(0);
  CHECK_FALSE(rigid.update(matrix));
  matrix = whole;
  matrix.component.clear();
  CHECK_FALSE(rigid.update(matrix));
  matrix = whole;
  for (int c = 0; c < matrix.columns(); ++c) matrix.component[c] = c / 8;
  CHECK_FALSE(rigid.update(matrix));
  matrix = whole;
  for (int c = 0; c < matrix.columns(); ++c) matrix.block(matrix.column_start[c]).diagonal().array() -= 0.1;
  CHECK_FALSE(rigid.update(matrix));
  CHECK(rigid.update(whole));
}

// Contrasts of 1e6 between bodies that are nearly free: masses are a thousandth to a millionth of springs.
TEST_CASE("with rigid motions conjugate gradients take a fraction of the iterations, and are correct", "[linear]") {
  const BlockMatrix matrix = solid_sheet_and_rod();
  RandomMotions random(3);
  const VecX b = random.vectors(matrix.size());
  const VecX exact = solve("cholmod", matrix, b).x;
  const auto error = [&](const VecX& x) {
    VecX product;
    matrix.multiply(x - exact, product);
    return std::sqrt((x - exact).dot(product) / exact.dot(b));
  };
  for (const double tolerance : {1e-6, 1e-8}) {
    for (const char* preconditioner : {"incomplete_cholesky", "block_jacobi"}) {
      INFO(preconditioner << " " << tolerance);
      const auto pcg = [&](const char* rigid) {
        return solve(fmt::format("{{type: pcg, preconditioner: {}, tolerance: {}, max_iterations: 20000, rigid_motions: {}}}",
                                 preconditioner, tolerance, rigid), matrix, b);
      };
      const Solved with = pcg("true"), without = pcg("false");
      CHECK(2 * with.iterations < without.iterations);
      CHECK(error(with.x) < 10 * tolerance);
      CHECK(error(with.x) < 2 * error(without.x));
    }
  }
}

TEST_CASE("rigid motions are not used for easy systems", "[linear]") {
  const BlockMatrix easy = solid_sheet_and_rod(1e5), hard = solid_sheet_and_rod();
  RandomMotions random(7);
  const VecX b = random.vectors(easy.size());
  const std::string pcg = "{type: pcg, preconditioner: block_jacobi, tolerance: 1e-3, max_iterations: 20000";
  const Solved with_easy = solve(pcg + "}", easy, b), without_easy = solve(pcg + ", rigid_motions: false}", easy, b);
  const Solved with_hard = solve(pcg + "}", hard, b), without_hard = solve(pcg + ", rigid_motions: false}", hard, b);
  REQUIRE(with_easy.iterations <= 4);
  REQUIRE(without_hard.iterations > 10);
  REQUIRE((with_easy.x != without_easy.x));
  const auto solver = component<LinearSolver>(pcg + "}");
  PhaseClock clock;
  const auto next = [&](const BlockMatrix& matrix) {
    VecX x;
    REQUIRE(solver->factorize(matrix, clock));
    solver->solve(b, x, clock);
    return x;
  };
  for (int i = 0; i < 4; ++i) CHECK((next(easy) == with_easy.x));
  for (int i = 0; i < 3; ++i) CHECK((next(easy) == without_easy.x));
  CHECK((next(hard) == without_hard.x));
  for (int i = 0; i < 6; ++i) CHECK((next(hard) == with_hard.x));
}

TEST_CASE("many unconnected bodies are solved in a few iterations", "[linear]") {
  std::vector<SpringLattice> bodies;
  for (int i = 0; i < 100; ++i) bodies.push_back({{4, 4, 4}, std::pow(10.0, i % 7 - 3), 1e-6, Vec3(10 * i, 0, 0)});
  const BlockMatrix matrix = spring_lattices(bodies);
  RandomMotions random(4);
  const VecX b = random.vectors(matrix.size());
  const Solved solved = solve("{type: pcg, tolerance: 1e-8}", matrix, b);
  CHECK(solved.iterations <= 40);
  VecX product;
  matrix.multiply(solved.x, product);
  CHECK((product - b).norm() < 1e-4 * b.norm());
}

TEST_CASE("rigid motions have the same bits for 1 and 2 threads", "[linear]") {
  const BlockMatrix matrix = solid_sheet_and_rod();
  RandomMotions random(5);
  const VecX b = random.vectors(matrix.size());
  const auto with_threads = [&](size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return solve("{type: pcg, tolerance: 1e-6}", matrix, b).x;
  };
  CHECK((with_threads(1) == with_threads(2)));
}

TEST_CASE("rigid motions do not hide an indefinite matrix", "[linear]") {
  BlockMatrix matrix = solid_sheet_and_rod(1e-3);
  for (int c = 0; c < matrix.columns(); ++c) matrix.block(matrix.column_start[c]).diagonal().array() -= 0.01;
  RandomMotions random(6);
  const VecX b = random.vectors(matrix.size());
  const auto solver = component<LinearSolver>("{type: pcg, tolerance: 1e-8}");
  PhaseClock clock;
  VecX x;
  if (!solver->factorize(matrix, clock)) return;
  solver->solve(b, x, clock);
  CHECK_FALSE(x.allFinite());
}
