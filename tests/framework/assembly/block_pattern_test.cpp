// Patterns of random blocks against sets of blocks, for any number of threads.
#include "framework/assembly/block_pattern.hpp"

#include <catch2/catch.hpp>
#include <tbb/global_control.h>

#include <algorithm>
#include <random>
#include <set>

using namespace tack;

namespace {

constexpr int columns = 700;  // several runs of columns

// Sorted, unique keys of random blocks of the lower triangle within some columns.
std::vector<BlockKey> random_keys(int count, int first, int last, std::mt19937& random) {
  std::uniform_int_distribution<int> column(first, last - 1), row(0, columns - 1);
  std::set<BlockKey> keys;
  for (int k = 0; k < count; ++k) {
    const int a = column(random), b = row(random);
    keys.insert(block_key(std::max(a, b), std::min(a, b)));
  }
  return {keys.begin(), keys.end()};
}

void check_structure(const BlockMatrix& matrix, const std::set<BlockKey>& expected) {
  std::vector<BlockKey> found;
  REQUIRE(matrix.columns() == columns);
  for (int c = 0; c < columns; ++c) {
    REQUIRE(matrix.row[matrix.column_start[c]] == c);
    for (int k = matrix.column_start[c]; k < matrix.column_start[c + 1]; ++k) found.push_back(block_key(matrix.row[k], c));
  }
  CHECK(std::equal(found.begin(), found.end(), expected.begin(), expected.end()));
  CHECK(matrix.values.size() == 9 * expected.size());
}

void check_positions(const BlockMatrix& matrix, const std::vector<BlockKey>& keys, const std::vector<int>& positions) {
  REQUIRE(positions.size() == keys.size());
  for (size_t k = 0; k < keys.size(); ++k)
    if (positions[k] != matrix.find(key_row(keys[k]), key_column(keys[k]))) FAIL("key " << k << " has another position");
}

}  // namespace

TEST_CASE("a pattern has the blocks of all stencils, for any number of threads", "[assembly]") {
  const int threads = GENERATE(1, 2, 4);
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
  std::mt19937 random(3);
  for (int trial = 0; trial < 10; ++trial) {
    const std::vector<BlockKey> lasting = random_keys(trial * 400, 0, columns, random);
    std::set<BlockKey> fixed(lasting.begin(), lasting.end());
    for (int c = 0; c < columns; ++c) fixed.insert(block_key(c, c));
    BlockPattern pattern(columns, lasting);
    CHECK(std::equal(fixed.begin(), fixed.end(), pattern.static_keys().begin(), pattern.static_keys().end()));

    BlockMatrix matrix;
    std::vector<int> positions;
    std::set<BlockKey> extra;  // dynamic blocks that the pattern keeps
    for (int round = 0; round < 8; ++round) {
      const std::vector<BlockKey> contacts = random_keys(round == 4 ? 20 : 300, 100 * round / 2, columns, random);
      const std::uint64_t version = matrix.version;
      const bool missing = round == 0 || std::any_of(contacts.begin(), contacts.end(), [&](BlockKey key) { return !fixed.contains(key) && !extra.contains(key); });
      if (missing && extra.size() > 3 * contacts.size() + 64) extra.clear();
      if (missing) extra.insert(contacts.begin(), contacts.end());
      CHECK(pattern.cover(contacts, matrix, positions) == missing);
      CHECK((matrix.version != version) == missing);
      std::set<BlockKey> all = fixed;
      all.insert(extra.begin(), extra.end());
      check_structure(matrix, all);
      check_positions(matrix, contacts, positions);
      check_positions(matrix, pattern.static_keys(), pattern.static_positions());
    }
  }
}

TEST_CASE("a pattern that grows by a few blocks keeps its memory", "[assembly]") {
  std::mt19937 random(4);
  BlockPattern pattern(columns, random_keys(5000, 0, columns, random));
  BlockMatrix matrix;
  std::vector<int> positions;
  pattern.cover({}, matrix, positions);
  const double* const values = matrix.values.data();
  const int* const rows = matrix.row.data();
  for (int round = 0; round < 4; ++round) REQUIRE(pattern.cover(random_keys(100, 0, columns, random), matrix, positions));
  CHECK(matrix.values.data() == values);
  CHECK(matrix.row.data() == rows);
}

TEST_CASE("a pattern without unknowns is empty", "[assembly]") {
  BlockPattern pattern(0, {});
  BlockMatrix matrix;
  std::vector<int> positions;
  pattern.cover({}, matrix, positions);
  CHECK(matrix.columns() == 0);
  CHECK(matrix.blocks() == 0);
}
