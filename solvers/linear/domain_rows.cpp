#include "solvers/linear/domain_rows.hpp"

#include <Eigen/Geometry>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <numeric>
#include <utility>

namespace tack {
namespace {

// Solids have eight or nine colours: these are 14 domains at a time for the threads.
constexpr int enough_domains = 128;
// Vertices of a domain: with fewer, solids took up to 7% more iterations.
constexpr int least_domain = 128;
constexpr int parallel_bisection = 8192;  // vertices; fewer are bisected by one thread

// Returns the first free colour of each domain in turn. `coupled` lists the other domains that each
// one is coupled to.
std::vector<int> greedy_colors(const std::vector<std::vector<int>>& coupled) {
  std::vector<int> color(coupled.size(), -1), taken_by;  // taken_by: the last domain with a neighbour of each colour
  for (int d = 0; d < static_cast<int>(coupled.size()); ++d) {
    for (const int other : coupled[d])
      if (color[other] >= 0) taken_by[color[other]] = d;
    const auto free = std::find_if(taken_by.begin(), taken_by.end(), [&](int by) { return by != d; });
    color[d] = static_cast<int>(free - taken_by.begin());
    if (free == taken_by.end()) taken_by.push_back(-1);
  }
  return color;
}

}  // namespace

// Blocks left of the diagonal of each row: the transpose of the matrix's pattern.
struct DomainRows::LeftBlocks {
  // Counts in runs of columns, which write without locks, in the order of columns.
  explicit LeftBlocks(const BlockMatrix& matrix) {
    constexpr int shortest_run = 4096, most_runs = 16;
    const int n = matrix.columns(), runs = std::clamp(n / shortest_run, 1, most_runs), run = (n + runs - 1) / runs;
    std::vector<int> next(runs * static_cast<size_t>(n));  // of each run and row
    const auto for_each_block = [&](const auto& body) {
      for_each(runs, [&](int i) {
        int* const of_run = next.data() + static_cast<size_t>(i) * n;
        for (int c = i * run; c < std::min(i * run + run, n); ++c)
          for (int k = matrix.column_start[c] + 1; k < matrix.column_start[c + 1]; ++k) body(of_run[matrix.row[k]], k, c);
      }, 1);
    };
    for_each_block([](int& count, int, int) { ++count; });
    start.resize(n + 1);
    start[0] = 0;
    for_each(n, [&](int r) {
      int sum = 0;
      for (int i = 0; i < runs; ++i) sum += next[static_cast<size_t>(i) * n + r];
      start[r + 1] = sum;
    }, 1024);
    std::partial_sum(start.begin(), start.end(), start.begin());
    for_each(n, [&](int r) {
      int at = start[r];
      for (int i = 0; i < runs; ++i) at += std::exchange(next[static_cast<size_t>(i) * n + r], at);
    }, 1024);
    block.resize(start.back());
    column.resize(start.back());
    for_each_block([&](int& at, int k, int c) {
      block[at] = k;
      column[at++] = c;
    });
  }
  std::vector<int> start, block, column;
};

void DomainRows::build(const BlockMatrix& matrix, int domain_size) {
  if (static_cast<int>(order_.size()) != matrix.columns() || component_ != matrix.component) {
    divide(matrix, domain_size);
    component_ = matrix.component;
  }
  color_domains(matrix);
  list_rows(matrix, LeftBlocks(matrix));
}

void DomainRows::divide(const BlockMatrix& matrix, int domain_size) {
  const int n = matrix.columns(), size = std::min(domain_size, std::max(least_domain, n / enough_domains));
  const int count = chunk_count(n, size);
  order_.resize(n);
  std::iota(order_.begin(), order_.end(), 0);
  order_start_.assign(count + 1, n);
  if (count > 0) bisect(matrix.positions, 0, n, 0, count);
}

// Divides the vertices first .. last - 1 of order_ into domains of nearly equal size, numbered from
// `domain` on.
void DomainRows::bisect(const VecX& positions, int first, int last, int domain, int domains) {
  const auto begin = order_.begin() + first, end = order_.begin() + last;
  if (domains == 1) {
    order_start_[domain] = first;
    std::sort(begin, end);
    return;
  }
  const int left = domains / 2, middle = first + static_cast<int>(static_cast<std::ptrdiff_t>(last - first) * left / domains);
  if (positions.size() > 0) {
    Eigen::AlignedBox3d box;
    std::for_each(begin, end, [&](int v) { box.extend(positions.segment<3>(3 * v)); });
    Eigen::Index axis;
    box.sizes().maxCoeff(&axis);
    std::nth_element(begin, order_.begin() + middle, end, [&](int a, int b) {
      const double x = positions(3 * a + axis), y = positions(3 * b + axis);
      return x != y ? x < y : a < b;
    });
  }
  const auto before = [&] { bisect(positions, first, middle, domain, left); };
  const auto after = [&] { bisect(positions, middle, last, domain + left, domains - left); };
  if (last - first > parallel_bisection) {
    tbb::parallel_invoke(before, after);
  } else {
    before();
    after();
  }
}

// Gives coupled domains different colours, and sorts the domains by colours.
void DomainRows::color_domains(const BlockMatrix& matrix) {
  const int n = matrix.columns(), count = static_cast<int>(order_start_.size()) - 1;
  std::vector<int> domain_of(n);
  for_each(count, [&](int d) {
    for (int k = order_start_[d]; k < order_start_[d + 1]; ++k) domain_of[order_[k]] = d;
  }, 1);
  std::vector<std::vector<int>> coupled(count);
  for_each(count, [&](int d) {
    std::vector<char> found(count, 0);
    for (int k = order_start_[d]; k < order_start_[d + 1]; ++k)
      for (int b = matrix.column_start[order_[k]]; b < matrix.column_start[order_[k] + 1]; ++b)
        if (const int other = domain_of[matrix.row[b]]; other != d && !found[other]) {
          found[other] = 1;
          coupled[d].push_back(other);
        }
  }, 1);
  for (int d = 0; d < count; ++d)  // both ways
    for (size_t i = 0, end = coupled[d].size(); i < end; ++i)
      if (std::vector<int>& back = coupled[coupled[d][i]]; std::find(back.begin(), back.end(), d) == back.end()) back.push_back(d);
  const std::vector<int> color = greedy_colors(coupled);
  color_start.assign(count == 0 ? 1 : *std::max_element(color.begin(), color.end()) + 2, 0);
  for (const int c : color) ++color_start[c + 1];
  std::partial_sum(color_start.begin(), color_start.end(), color_start.begin());
  std::vector<int> domain(count), next = color_start;  // domain: its number in the order, by colours
  for (int d = 0; d < count; ++d) domain[next[color[d]]++] = d;
  domain_start.assign(1, 0);
  for (const int d : domain) domain_start.push_back(domain_start.back() + order_start_[d + 1] - order_start_[d]);
  vertex.resize(n);
  for_each(count, [&](int i) {
    std::copy(order_.begin() + order_start_[domain[i]], order_.begin() + order_start_[domain[i] + 1], vertex.begin() + domain_start[i]);
  }, 1);
}

void DomainRows::list_rows(const BlockMatrix& matrix, const LeftBlocks& left) {
  const int n = matrix.columns();
  std::vector<int> row_of(n);
  for_each(n, [&](int k) { row_of[vertex[k]] = k; }, 4096);
  // Calls body(other row, source) for each block off the diagonal of row k.
  const auto for_each_coupling = [&](int k, const auto& body) {
    const int v = vertex[k];
    for (int b = matrix.column_start[v] + 1; b < matrix.column_start[v + 1]; ++b) {
      const int other = row_of[matrix.row[b]];
      body(other, Source{b, other < k});
    }
    for (int b = left.start[v]; b < left.start[v + 1]; ++b) {
      const int other = row_of[left.column[b]];
      body(other, Source{left.block[b], k < other});
    }
  };
  row_start.resize(n + 1);
  below_start.resize(n + 1);
  row_start[0] = below_start[0] = 0;
  for_each(n, [&](int k) {
    int before = 1, after = 0;
    for_each_coupling(k, [&](int other, Source) { ++(other < k ? before : after); });
    row_start[k + 1] = before;
    below_start[k + 1] = after;
  }, 512);
  std::partial_sum(row_start.begin(), row_start.end(), row_start.begin());
  std::partial_sum(below_start.begin(), below_start.end(), below_start.begin());
  column.resize(row_start.back());
  source.resize(row_start.back());
  below_row.resize(below_start.back());
  below_entry.resize(below_start.back());
  for_each_chunk(n, [&](int, int first, int last) {
    std::vector<std::pair<int, Source>> entries;
    for (int k = first; k < last; ++k) {
      entries.clear();
      int below = below_start[k];
      for_each_coupling(k, [&](int other, Source from) {
        if (other > k) below_row[below++] = other;
        else entries.emplace_back(other, from);
      });
      std::sort(below_row.begin() + below_start[k], below_row.begin() + below_start[k + 1]);
      std::sort(entries.begin(), entries.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
      int e = row_start[k];
      for (const auto& [other, from] : entries) {
        column[e] = other;
        source[e++] = from;
      }
      column[e] = k;
      source[e] = {matrix.column_start[vertex[k]], false};
    }
  }, 512);
  for_each(n, [&](int k) {
    for (int b = below_start[k]; b < below_start[k + 1]; ++b) {
      const auto begin = column.begin() + row_start[below_row[b]];  // rows are short
      below_entry[b] = static_cast<int>(std::find(begin, column.end(), k) - column.begin());
    }
  }, 512);
}

}  // namespace tack
