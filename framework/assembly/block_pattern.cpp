#include "framework/assembly/block_pattern.hpp"

#include <algorithm>
#include <atomic>

#include "geometry/parallel.hpp"
#include "geometry/prefix_sums.hpp"

namespace tack {
namespace {

constexpr int pattern_columns_per_chunk = 128;

// Extra blocks beyond this multiple of those in use are dropped: explicit zeros cost fill.
constexpr size_t keep_factor = 3;

// Consecutive keys of a list.
struct KeyRange {
  const BlockKey *begin, *end;
};

// Returns the keys of the columns first .. last - 1.
KeyRange keys_of_columns(const std::vector<BlockKey>& keys, int first, int last) {
  const auto at = [&](int column) {
    return keys.data() + (std::lower_bound(keys.begin(), keys.end(), block_key(0, column)) - keys.begin());
  };
  return {at(first), at(last)};
}

// Calls visit(key, whether it is in a) for each key of the union, ascending.
template <class Visit>
void visit_union(KeyRange a, KeyRange b, const Visit& visit) {
  while (a.begin != a.end || b.begin != b.end) {
    const bool in_a = b.begin == b.end || (a.begin != a.end && *a.begin <= *b.begin);
    const BlockKey key = in_a ? *a.begin : *b.begin;
    if (b.begin != b.end && *b.begin == key) ++b.begin;
    a.begin += in_a;
    visit(key, in_a);
  }
}

// Returns the union of two lists, by runs of columns: where the keys of each run begin in it, and the end.
std::vector<size_t> union_offsets(const std::vector<BlockKey>& a, const std::vector<BlockKey>& b, int columns) {
  std::vector<size_t> begin(chunk_count(columns, pattern_columns_per_chunk) + 1, 0);
  for_each_chunk(columns, [&](int c, int first, int last) {
    size_t count = 0;
    visit_union(keys_of_columns(a, first, last), keys_of_columns(b, first, last), [&](BlockKey, bool) { ++count; });
    begin[c + 1] = count;
  }, pattern_columns_per_chunk);
  prefix_sums(begin);
  return begin;
}

std::vector<BlockKey> union_of(const std::vector<BlockKey>& a, const std::vector<BlockKey>& b, int columns) {
  const std::vector<size_t> begin = union_offsets(a, b, columns);
  std::vector<BlockKey> all(begin.back());
  for_each_chunk(columns, [&](int c, int first, int last) {
    BlockKey* next = all.data() + begin[c];
    visit_union(keys_of_columns(a, first, last), keys_of_columns(b, first, last), [&](BlockKey key, bool) { *next++ = key; });
  }, pattern_columns_per_chunk);
  return all;
}

// Sets the size of a list whose contents are written next. Patterns grow by a few blocks at a time: a list of just
// the size would be new memory each time.
template <class T>
void resize_with_room(std::vector<T>& list, size_t n) {
  if (list.capacity() < n) {
    list = std::vector<T>();
    list.reserve(n + n / 8);
  }
  list.resize(n);
}

// Returns a version that is unique among all patterns. A solver may get the matrix of another pattern, for
// instance when a motion releases its vertices, and must then repeat its analysis.
std::uint64_t next_version() {
  static std::atomic<std::uint64_t> last = 0;
  return ++last;
}

}  // namespace

BlockPattern::BlockPattern(int columns, const std::vector<BlockKey>& static_keys) : columns_(columns) {
  std::vector<BlockKey> diagonals(columns);
  for_each(columns, [&](int c) { diagonals[c] = block_key(c, c); });
  static_keys_ = union_of(static_keys, diagonals, columns);
}

bool BlockPattern::cover(const std::vector<BlockKey>& dynamic_keys, BlockMatrix& matrix,
                         std::vector<int>& positions) {
  positions.resize(dynamic_keys.size());
  // Returns whether the matrix has all of the keys.
  const auto find = [&] {
    std::atomic<bool> found = true;
    for_each(static_cast<int>(dynamic_keys.size()), [&](int k) {
      positions[k] = matrix.find(key_row(dynamic_keys[k]), key_column(dynamic_keys[k]));
      if (positions[k] < 0) found.store(false, std::memory_order_relaxed);
    });
    return found.load();
  };
  if (matrix.columns() == columns_ && !static_positions_.empty() && find()) return false;
  const bool keep = extra_keys_.size() <= keep_factor * dynamic_keys.size() + 64;
  extra_keys_ = keep ? union_of(extra_keys_, dynamic_keys, columns_) : dynamic_keys;
  rebuild(matrix);
  find();
  return true;
}

void BlockPattern::rebuild(BlockMatrix& matrix) {
  const std::vector<size_t> begin = union_offsets(static_keys_, extra_keys_, columns_);
  matrix.column_start.resize(columns_ + 1);
  matrix.column_start.back() = static_cast<int>(begin.back());
  resize_with_room(matrix.row, begin.back());
  resize_with_room(matrix.values, 9 * begin.back());
  static_positions_.resize(static_keys_.size());
  for_each_chunk(columns_, [&](int c, int first, int last) {
    const KeyRange own = keys_of_columns(static_keys_, first, last);
    int position = static_cast<int>(begin[c]);
    int* static_position = static_positions_.data() + (own.begin - static_keys_.data());
    visit_union(own, keys_of_columns(extra_keys_, first, last), [&](BlockKey key, bool is_static) {
      matrix.row[position] = key_row(key);
      if (key_row(key) == key_column(key)) matrix.column_start[key_column(key)] = position;  // the first of its column
      if (is_static) *static_position++ = position;
      ++position;
    });
  }, pattern_columns_per_chunk);
  matrix.version = next_version();
}

}  // namespace tack
