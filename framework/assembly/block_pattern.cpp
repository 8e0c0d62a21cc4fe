#include "framework/assembly/block_pattern.hpp"

#include <algorithm>
#include <atomic>
#include <iterator>

#include "geometry/parallel.hpp"

namespace tack {
namespace {

std::vector<BlockKey> merged(const std::vector<BlockKey>& a, const std::vector<BlockKey>& b) {
  std::vector<BlockKey> all;
  all.reserve(a.size() + b.size());
  std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(all));
  return all;
}

// Extra blocks beyond this multiple of those in use are dropped: explicit zeros cost fill.
constexpr size_t keep_factor = 3;

}  // namespace

BlockPattern::BlockPattern(int columns, std::vector<BlockKey> static_keys)
    : columns_(columns), static_keys_(std::move(static_keys)) {
  for (int c = 0; c < columns; ++c) static_keys_.push_back(block_key(c, c));
  std::sort(static_keys_.begin(), static_keys_.end());
  static_keys_.erase(std::unique(static_keys_.begin(), static_keys_.end()), static_keys_.end());
}

bool BlockPattern::cover(const std::vector<BlockKey>& dynamic_keys, BlockMatrix& matrix,
                         std::vector<int>& positions) {
  positions.resize(dynamic_keys.size());
  const auto find = [&] {
    for_each(static_cast<int>(dynamic_keys.size()), [&](int k) {
      positions[k] = matrix.find(key_row(dynamic_keys[k]), key_column(dynamic_keys[k]));
    });
  };
  if (matrix.columns() == columns_ && !static_positions_.empty()) {
    find();
    if (std::find(positions.begin(), positions.end(), -1) == positions.end()) return false;
  }
  const bool keep = extra_keys_.size() <= keep_factor * dynamic_keys.size() + 64;
  extra_keys_ = keep ? merged(extra_keys_, dynamic_keys) : dynamic_keys;
  rebuild(matrix);
  find();
  return true;
}

// Returns a version that is unique among all patterns. A solver may get the matrix of another pattern, for
// instance when a motion releases its vertices, and must then repeat its analysis.
static std::uint64_t next_version() {
  static std::atomic<std::uint64_t> last = 0;
  return ++last;
}

void BlockPattern::rebuild(BlockMatrix& matrix) {
  const auto keys = merged(static_keys_, extra_keys_);
  matrix.column_start.assign(columns_ + 1, 0);
  matrix.row.resize(keys.size());
  for (size_t k = 0; k < keys.size(); ++k) {
    matrix.row[k] = key_row(keys[k]);
    ++matrix.column_start[key_column(keys[k]) + 1];
  }
  for (int c = 0; c < columns_; ++c) matrix.column_start[c + 1] += matrix.column_start[c];
  matrix.values.assign(9 * keys.size(), 0.0);
  matrix.version = next_version();

  static_positions_.resize(static_keys_.size());
  size_t position = 0;
  for (size_t k = 0; k < static_keys_.size(); ++k) {
    while (keys[position] != static_keys_[k]) ++position;
    static_positions_[k] = static_cast<int>(position);
  }
}

}  // namespace tack
