#include "solvers/linear/component_translations.hpp"

#include <algorithm>

#include "framework/core/lanes.hpp"
#include "geometry/parallel.hpp"
#include "solvers/linear/component_sizes.hpp"

namespace tack {
namespace {

constexpr int longest_run = 512;  // columns

// Returns a view of columns first .. last - 1 of vectors, 3 numbers each.
template <class Matrix, class Number>
Eigen::Map<Matrix> of_run(Number* vectors, int first, int last) {
  return {vectors + 3 * static_cast<size_t>(first), 3, last - first};
}

}  // namespace

void ComponentTranslations::index(const BlockMatrix& matrix) {
  columns_ = matrix.columns();
  version_ = matrix.version;
  components_ = 0;
  component_of_.assign(columns_, -1);
  if (static_cast<int>(matrix.component.size()) != columns_) return;
  const std::vector<int> size = component_sizes(matrix);
  std::vector<int> number(size.size(), -1);
  for (size_t p = 0; p < size.size(); ++p)
    if (size[p] >= smallest_component) number[p] = components_++;
  for (int c = 0; c < columns_; ++c) component_of_[c] = number[matrix.component[c]];

  runs_.clear();
  for (int c = 0; c < columns_; ++c) {
    if (component_of_[c] < 0) continue;
    const bool longer = !runs_.empty() && runs_.back().last == c && runs_.back().component == component_of_[c] &&
                        c - runs_.back().first < longest_run;
    if (longer) {
      runs_.back().last = c + 1;
    } else {
      runs_.push_back({c, c + 1, component_of_[c], Vec3::Zero(), {}});
    }
  }

  using Pair = std::pair<int, int>;  // column, row
  const auto pair_of = [&](int c, int k) -> Pair { return std::minmax(component_of_[c], component_of_[matrix.row[k]]); };
  const auto sort = [](std::vector<Pair>& pairs) {
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  };
  const int runs = static_cast<int>(runs_.size());
  std::vector<std::vector<Pair>> of_run(runs);
  for_each(runs, [&](int i) {
    std::vector<Pair>& pairs = of_run[i];
    for (int c = runs_[i].first; c < runs_[i].last; ++c)
      for (int k = matrix.column_start[c]; k < matrix.column_start[c + 1]; ++k)
        if (const Pair pair = pair_of(c, k); pair.first >= 0 && (pairs.empty() || pairs.back() != pair)) pairs.push_back(pair);
    sort(pairs);
  }, 1);
  std::vector<Pair> all;
  for (const std::vector<Pair>& pairs : of_run) all.insert(all.end(), pairs.begin(), pairs.end());
  sort(all);
  coarse_.clear();
  for (const auto& [column, row] : all) coarse_.push_back({row, column, Mat3::Zero()});
  coarse_of_.assign(matrix.row.size(), -1);
  for_each(runs, [&](int i) {
    Pair last{-1, -1};
    int at = -1;
    for (int c = runs_[i].first; c < runs_[i].last; ++c)
      for (int k = matrix.column_start[c]; k < matrix.column_start[c + 1]; ++k) {
        const Pair pair = pair_of(c, k);
        if (pair.first < 0) continue;
        if (pair != last) at = static_cast<int>(std::lower_bound(all.begin(), all.end(), pair) - all.begin());
        last = pair;
        coarse_of_[k] = at;
      }
  }, 1);
}

// Sums the blocks of the run's columns by coarse blocks. Consecutive blocks mostly belong to one
// sum, which stays in registers.
void ComponentTranslations::sum_blocks(const BlockMatrix& matrix, Run& run) const {
  BlockLanes sum;
  int at = -1;
  run.coarse_sums.clear();
  const auto end_sum = [&] {
    if (at < 0) return;
    run.coarse_sums.emplace_back(at, Mat3());
    sum.store(run.coarse_sums.back().second.data());
  };
  for (int c = run.first; c < run.last; ++c) {
    for (int k = matrix.column_start[c]; k < matrix.column_start[c + 1]; ++k) {
      if (coarse_of_[k] < 0) continue;
      if (coarse_of_[k] != at) {
        end_sum();
        at = coarse_of_[k];
        sum = BlockLanes();
      }
      // The matrix stores blocks below its diagonal only.
      BlockLanes block(matrix.values.data() + 9 * static_cast<std::ptrdiff_t>(k));
      if (matrix.row[k] == c) block *= 0.5;
      if (component_of_[matrix.row[k]] < component_of_[c]) block = block.transposed();
      sum += block;
    }
  }
  end_sum();
}

void ComponentTranslations::update(const BlockMatrix& matrix) {
  const bool changed = matrix.version != version_ || matrix.columns() != columns_;
  if (changed) index(matrix);
  if (components_ == 0) return;
  const int runs = static_cast<int>(runs_.size());
  for_each(runs, [&](int i) { sum_blocks(matrix, runs_[i]); }, 1);
  for (Coarse& block : coarse_) block.sum.setZero();
  for (const Run& run : runs_)
    for (const auto& [at, sum] : run.coarse_sums) coarse_[at].sum += sum;
  for (Coarse& block : coarse_)  // inside one component the transposed blocks count too
    if (block.row == block.column) block.sum += block.sum.transpose().eval();
  std::vector<Eigen::Triplet<double>> entries;
  for (const Coarse& block : coarse_)
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        if (3 * block.row + i >= 3 * block.column + j)
          entries.emplace_back(3 * block.row + i, 3 * block.column + j, block.sum(i, j));
  Sparse sum(3 * components_, 3 * components_);
  sum.setFromTriplets(entries.begin(), entries.end());
  if (changed) factor_.analyzePattern(sum);
  factor_.factorize(sum);
  usable_ = factor_.info() == Eigen::Success;
}

double ComponentTranslations::add(const VecX& r, VecX& z) {
  if (components_ == 0 || !usable_) return 0;
  const int runs = static_cast<int>(runs_.size());
  for_each(runs, [&](int i) {
    runs_[i].sum = of_run<const Eigen::Matrix3Xd>(r.data(), runs_[i].first, runs_[i].last).rowwise().sum();
  }, 1);
  sums_.setZero(3 * components_);
  for (const Run& run : runs_) sums_.segment<3>(3 * run.component) += run.sum;
  const VecX shifts = factor_.solve(sums_);
  for_each(runs, [&](int i) {
    of_run<Eigen::Matrix3Xd>(z.data(), runs_[i].first, runs_[i].last).colwise() += shifts.segment<3>(3 * runs_[i].component);
  }, 1);
  return sums_.dot(shifts);
}

}  // namespace tack
