#include "framework/core/block_matrix.hpp"

#include <catch2/catch.hpp>

#include "tests/support/random_blocks.hpp"

using namespace tack;

TEST_CASE("block matrix times vector is the dense product", "[core]") {
  RandomMotions random(1);
  for (const int columns : {1, 2, 7, 40}) {
    const BlockMatrix matrix = random_spd(columns, random);
    const VecX x = random.vectors(matrix.size());
    VecX y = VecX::Constant(3, 99);  // whatever was there is replaced
    matrix.multiply(x, y);
    CHECK((y - dense(matrix) * x).norm() <= 1e-13 * y.norm());
  }
}

TEST_CASE("block matrix: blocks are found by row and column", "[core]") {
  RandomMotions random(2);
  const BlockMatrix matrix = random_spd(20, random);
  int found = 0;
  for (int c = 0; c < 20; ++c) {
    for (int r = c; r < 20; ++r) {
      const int k = matrix.find(r, c);
      if (k < 0) continue;
      ++found;
      CHECK(matrix.row[k] == r);
      CHECK((k >= matrix.column_start[c] && k < matrix.column_start[c + 1]));
    }
  }
  CHECK(found == matrix.blocks());
  CHECK(BlockMatrix().size() == 0);
}
