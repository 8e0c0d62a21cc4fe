#include "framework/core/block_matrix.hpp"

#include <catch2/catch.hpp>
#include <tbb/global_control.h>

#include "framework/core/symmetric_product.hpp"
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

TEST_CASE("symmetric products read runs of columns side by side", "[core]") {
  RandomMotions random(3);
  SymmetricProduct product;
  for (const BlockMatrix& matrix : {random_spd(5, random), grid(14, random), random_spd(2500, random, 7)}) {
    INFO(matrix.columns() << " columns");
    const VecX x = random.vectors(matrix.size());
    VecX y, expected;
    matrix.multiply(x, expected);
    for (int again = 0; again < 2; ++again) {
      product.multiply(matrix, x, y);
      CHECK((y - expected).norm() <= 1e-14 * matrix.columns() * expected.norm());
    }
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
    VecX alone;
    product.multiply(matrix, x, alone);
    CHECK((alone == y));
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
