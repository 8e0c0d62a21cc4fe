// Data that an incomplete factor stores from one system to the next.
#include <catch2/catch.hpp>

#include "framework/core/linear_solver.hpp"
#include "tests/support/component_variants.hpp"
#include "tests/support/random_blocks.hpp"

using namespace tack;

namespace {

// `copies` of Kershaw's matrix, whose incomplete factor has a negative pivot, with couplings `scale` times as strong.
BlockMatrix kershaw_blocks(int copies, double scale) {
  static std::uint64_t versions = 1u << 29;
  const double entries[4][4] = {{3, -2, 0, 2}, {-2, 3, -2, 0}, {0, -2, 3, -2}, {2, 0, -2, 3}};
  BlockMatrix matrix;
  matrix.version = ++versions;
  matrix.column_start.push_back(0);
  for (int c = 0; c < 4 * copies; ++c) {
    for (int r = c % 4; r < 4; ++r) {
      if (entries[r][c % 4] == 0) continue;
      matrix.row.push_back(c - c % 4 + r);
      const Mat3 block = entries[r][c % 4] * (r == c % 4 ? 1 : scale) * Mat3::Identity();
      matrix.values.insert(matrix.values.end(), block.data(), block.data() + 9);
    }
    matrix.column_start.push_back(static_cast<int>(matrix.row.size()));
  }
  return matrix;
}

}  // namespace

TEST_CASE("large incomplete factors begin with the last shift, and try a smaller shift at intervals", "[linear]") {
  const BlockMatrix breaks = kershaw_blocks(1300, 1), does_not = kershaw_blocks(1300, 0.5), small = kershaw_blocks(10, 0.5);
  RandomMotions random(1);
  const VecX b = random.vectors(breaks.size());
  PhaseClock clock;
  const auto solve = [&](LinearSolver& solver, const BlockMatrix& matrix) {
    VecX x, product;
    REQUIRE(solver.factorize(matrix, clock));
    solver.solve(b.head(matrix.size()), x, clock);
    matrix.multiply(x, product);
    CHECK((product - b.head(matrix.size())).norm() < 1e-5 * b.norm());
    return x;
  };
  const auto fresh = [&](const BlockMatrix& matrix) { return solve(*component<LinearSolver>("{type: pcg, preconditioner: incomplete_cholesky, tolerance: 1e-8}"), matrix); };
  const auto kept = component<LinearSolver>("{type: pcg, preconditioner: incomplete_cholesky, tolerance: 1e-8}");
  for (int i = 0; i < 3; ++i) CHECK((solve(*kept, breaks) == fresh(breaks)));
  CHECK((solve(*kept, does_not) != fresh(does_not)));  // shifted, where it need not be
  for (int i = 0; i < 50; ++i) solve(*kept, does_not);
  CHECK((solve(*kept, does_not) == fresh(does_not)));
  solve(*kept, breaks);
  CHECK((solve(*kept, small) == fresh(small)));  // another size has no stored data
  CHECK((solve(*kept, breaks) == fresh(breaks)));
}
