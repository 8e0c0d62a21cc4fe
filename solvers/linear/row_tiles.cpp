#include "solvers/linear/row_tiles.hpp"

#include <algorithm>
#include <numeric>

#include "geometry/concatenate.hpp"
#include "geometry/parallel.hpp"

namespace tack {
namespace {

// Rows of a tile. One of 8 rows takes 0.2 us, about as long as waiting for another thread; longer
// ones than lines gain nothing.
constexpr int tile_min = 8, tile_max = 256;
// Tiles that are enough for the fronts of a solid: in larger systems, short lines are joined.
constexpr int enough_tiles = 512, joined_max = 64;
constexpr int tiles_per_task = 32;

// Fraction of all tiles that a strip may have; else lines wait for each other, as in a sheet.
constexpr double strip_max = 1.0 / 8;

// Sets the strips: chunks that each wait for the one before.
void find_strips(ChunkOrder& order) {
  order.strip_start.clear();
  for (int c = 0; c < order.chunks(); ++c) {
    const auto begin = order.before.begin() + order.start[c], end = order.before.begin() + order.start[c + 1];
    if (std::find(begin, end, c - 1) == end) order.strip_start.push_back(c);
  }
  order.strip_start.push_back(order.chunks());
}

int longest_strip(const ChunkOrder& order) {
  int longest = 0;
  for (size_t s = 0; s + 1 < order.strip_start.size(); ++s) longest = std::max(longest, order.strip_start[s + 1] - order.strip_start[s]);
  return longest;
}

// Returns the tiles that find(t, mark, tiles) appends to `tiles` for each tile t. mark: a number for each tile, less
// than t if find has not written it for t.
template <class Find>
ChunkOrder collect(int count, const Find& find) {
  std::vector<std::vector<int>> found(chunk_count(count, tiles_per_task));
  ChunkOrder order;
  order.start.resize(count + 1);
  for_each_chunk(count, [&](int chunk, int first, int last) {
    std::vector<int> mark(count, -1);
    for (int t = first; t < last; ++t) {
      const size_t size = found[chunk].size();
      find(t, mark, found[chunk]);
      order.start[t + 1] = static_cast<int>(found[chunk].size() - size);
    }
  }, tiles_per_task);
  std::partial_sum(order.start.begin(), order.start.end(), order.start.begin());
  concatenate(found, order.before);
  return order;
}

}  // namespace

RowTiles::RowTiles(const LowerRows& rows) {
  cut(rows, tile_max);
  connect(rows);
  if (longest_strip(before) <= strip_max * count()) return;
  cut(rows, tile_min);
  connect(rows);
}

// Cuts the rows between lines, which are runs of rows each coupled to the one before, and lines
// longer than `limit` into pieces of equal length.
void RowTiles::cut(const LowerRows& rows, int limit) {
  const int n = rows.size(), joined_limit = std::clamp(n / enough_tiles, tile_min, joined_max);
  const auto joined = [&](int row) {  // to the row before
    const int diagonal = rows.diagonal(row);
    return diagonal > rows.row_start[row] && rows.column[diagonal - 1] == row - 1;
  };
  start.assign(1, 0);
  for (int first = 0; first < n;) {
    int last = first + 1;
    while (last < n && joined(last)) ++last;
    if (start.size() > 1 && last - start[start.size() - 2] <= joined_limit) {
      start.back() = last;
    } else {
      const int length = last - first, pieces = (length + limit - 1) / limit;
      for (int p = 1; p <= pieces; ++p) start.push_back(first + static_cast<int>(static_cast<long>(length) * p / pieces));
    }
    first = last;
  }
}

void RowTiles::connect(const LowerRows& rows) {
  std::vector<int> tile_of(rows.size());
  for_each(count(), [&](int t) { std::fill(tile_of.begin() + start[t], tile_of.begin() + start[t + 1], t); }, tiles_per_task);
  const ChunkOrder all = collect(count(), [&](int t, std::vector<int>& found, std::vector<int>& tiles) {  // of the columns of each tile's rows
    for (int e = rows.row_start[start[t]]; e < rows.row_start[start[t + 1]]; ++e)
      if (const int other = tile_of[rows.column[e]]; other != t && found[other] != t) {
        found[other] = t;
        tiles.push_back(other);
      }
  });
  before = collect(count(), [&](int t, std::vector<int>& implied, std::vector<int>& tiles) {
    for (int k = all.start[t]; k < all.start[t + 1]; ++k)
      for (int l = all.start[all.before[k]]; l < all.start[all.before[k] + 1]; ++l) implied[all.before[l]] = t;
    for (int k = all.start[t]; k < all.start[t + 1]; ++k)
      if (implied[all.before[k]] != t) tiles.push_back(all.before[k]);
  });
  find_strips(before);
}

ChunkOrder RowTiles::order() const {
  ChunkOrder order = before;
  std::vector<int> later_start(count() + 1, 0), later(before.before.size());  // tiles that wait for each tile
  for (const int tile : before.before) ++later_start[tile + 1];
  std::partial_sum(later_start.begin(), later_start.end(), later_start.begin());
  std::vector<int> next = later_start;
  for (int t = 0; t < count(); ++t)
    for (int k = before.start[t]; k < before.start[t + 1]; ++k) later[next[before.before[k]]++] = t;
  const int last = 2 * count() - 1;  // chunk last - t: tile t backwards
  for (int t = count() - 1; t >= 0; --t) {
    if (later_start[t] == later_start[t + 1]) order.before.push_back(t);  // others wait for it forwards
    for (int k = later_start[t]; k < later_start[t + 1]; ++k) order.before.push_back(last - later[k]);
    order.start.push_back(static_cast<int>(order.before.size()));
  }
  find_strips(order);
  return order;
}

}  // namespace tack
