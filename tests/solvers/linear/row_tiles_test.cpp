// Rows of the lower triangle, and the tiles that triangular solves of several threads take.
#include <catch2/catch.hpp>

#include <algorithm>

#include "solvers/linear/row_tiles.hpp"
#include "tests/support/random_blocks.hpp"

using namespace tack;

namespace {

// Returns, for each chunk, which chunks have ended when it begins.
std::vector<std::vector<bool>> ended_before(const ChunkOrder& order) {
  std::vector<std::vector<bool>> ended(order.chunks(), std::vector<bool>(order.chunks(), false));
  for (int c = 0; c < order.chunks(); ++c)
    for (int k = order.start[c]; k < order.start[c + 1]; ++k) {
      const int before = order.before[k];
      REQUIRE(before < c);
      ended[c][before] = true;
      for (int b = 0; b < before; ++b)
        if (ended[before][b]) ended[c][b] = true;
    }
  return ended;
}

}  // namespace

TEST_CASE("rows of the lower triangle have the blocks of the matrix", "[linear]") {
  RandomMotions random(6);
  for (const BlockMatrix& matrix : {grid(22, random), random_spd(60, random), BlockMatrix()}) {  // 22^3: several runs of columns
    LowerRows rows;
    rows.build(matrix);
    REQUIRE(rows.size() == matrix.columns());
    REQUIRE(rows.column.size() == matrix.row.size());
    for (int r = 0; r < rows.size(); ++r) {
      REQUIRE(rows.column[rows.diagonal(r)] == r);
      for (int e = rows.row_start[r]; e < rows.row_start[r + 1]; ++e) {
        REQUIRE((e == rows.row_start[r] || rows.column[e - 1] < rows.column[e]));
        REQUIRE(matrix.find(r, rows.column[e]) == rows.block[e]);
        REQUIRE(rows.entry[rows.block[e]] == e);
      }
    }
  }
}

TEST_CASE("a tile waits for all tiles that its rows are coupled to, forwards and backwards", "[linear]") {
  RandomMotions random(8);
  for (const BlockMatrix& matrix : {grid(9, random), random_spd(200, random)}) {
    LowerRows rows;
    rows.build(matrix);
    const RowTiles tiles(rows);
    const int count = tiles.count();
    REQUIRE(tiles.start.front() == 0);
    REQUIRE(tiles.start.back() == rows.size());
    std::vector<int> tile_of(rows.size());
    for (int t = 0; t < count; ++t) {
      REQUIRE(tiles.start[t] < tiles.start[t + 1]);
      for (int i = tiles.start[t]; i < tiles.start[t + 1]; ++i) tile_of[i] = t;
    }
    const ChunkOrder order = tiles.order();
    REQUIRE(order.chunks() == 2 * count);
    const auto ended = ended_before(order);
    for (int i = 0; i < rows.size(); ++i) {
      const int t = tile_of[i];
      REQUIRE(ended[2 * count - 1 - t][t]);
      for (int e = rows.row_start[i]; e < rows.diagonal(i); ++e)
        if (const int other = tile_of[rows.column[e]]; other != t) {
          REQUIRE(ended[t][other]);
          REQUIRE(ended[2 * count - 1 - other][2 * count - 1 - t]);
        }
    }
    CHECK(order.strip_start.front() == 0);
    CHECK(order.strip_start.back() == order.chunks());
    CHECK(std::is_sorted(order.strip_start.begin(), order.strip_start.end()));
  }
}

TEST_CASE("solids have many tiles that do not wait for each other", "[linear]") {
  RandomMotions random(9);
  LowerRows rows;
  rows.build(grid(20, random));
  const RowTiles tiles(rows);
  std::vector<int> level(tiles.count(), 1);
  for (int t = 0; t < tiles.count(); ++t)
    for (int k = tiles.before.start[t]; k < tiles.before.start[t + 1]; ++k) level[t] = std::max(level[t], level[tiles.before.before[k]] + 1);
  CHECK(tiles.count() >= 400);
  CHECK(tiles.order().strip_start.size() == 2 * 20);  // layers forwards and backwards; the last one turns back
  CHECK(tiles.count() >= 10 * *std::max_element(level.begin(), level.end()));
}
