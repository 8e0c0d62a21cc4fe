#include "solvers/linear/matrix_sweeps.hpp"

#include <algorithm>
#include <atomic>
#include <utility>

#include "framework/core/lanes.hpp"
#include "geometry/parallel.hpp"

namespace tack {
namespace {

// w; many systems of contact and elasticity break down with 1, none with 0.4 to 0.7
constexpr double weight = 0.5;
// Fraction of A_ii that a pivot keeps: eigenvalues of M^-1 A are at most 1 / (2 - 1 / 0.6) = 3.
constexpr double least_left = 0.6;
constexpr int rows_per_look = 256;  // rows between checks of the deadline

template <class T>
T* row4(T* numbers, int i) { return numbers + 4 * static_cast<std::ptrdiff_t>(i); }
template <class T>
T* row9(T* numbers, int i) { return numbers + 9 * static_cast<std::ptrdiff_t>(i); }

// L D L^T factor of a symmetric block.
struct Ldl {
  template <class Entry>
  explicit Ldl(const Entry& a) {
    const double a10 = a(1, 0), a20 = a(2, 0);
    d0 = a(0, 0);
    l10 = a10 / d0;
    l20 = a20 / d0;
    d1 = a(1, 1) - l10 * a10;
    const double a21 = a(2, 1) - l20 * a10;
    l21 = a21 / d1;
    d2 = a(2, 2) - l20 * a20 - l21 * a21;
  }
  bool definite() const { return d0 > 0 && d1 > 0 && d2 > 0; }
  // Writes the nine numbers of the inverse.
  void invert(double* to) const {
    const double m20 = l10 * l21 - l20, e0 = 1 / d0, e1 = 1 / d1, e2 = 1 / d2;  // L^-1 has -l10, m20, -l21
    to[8] = e2;
    to[5] = to[7] = -l21 * e2;
    to[2] = to[6] = m20 * e2;
    to[4] = e1 + l21 * l21 * e2;
    to[1] = to[3] = -l10 * e1 - l21 * m20 * e2;
    to[0] = e0 + l10 * l10 * e1 + m20 * m20 * e2;
  }
  double d0, d1, d2, l10, l20, l21;
};

// inverse <- (own - w update)^-1, or own^-1 if the difference is nearly singular. Returns false if
// `own` is not positive definite.
bool invert_pivot(const double* own, const double* update, double* inverse) {
  const auto less = [&](double part, double of_update) {
    return [=](int i, int j) { return part * own[i + 3 * j] - of_update * update[i + 3 * j]; };
  };
  Ldl pivot(less(1, weight));
  if (!Ldl(less(1 - least_left, weight)).definite() || !pivot.definite()) pivot = Ldl(less(1, 0));
  pivot.invert(inverse);
  return pivot.definite();
}

}  // namespace

// The arrays that loops read, as local values: stores in the loops cannot alias them.
struct MatrixSweeps::View {
  const double* block(int entry) const { return row9(values, source[entry] >> 1); }
  bool turned(int entry) const { return source[entry] & 1; }
  const int *vertex, *start, *target, *source, *diagonal;
  const double *values, *inverse;
  double *z, *p, *lower, *product;
};

MatrixSweeps::View MatrixSweeps::view() {
  return {rows_.vertex.data(), start_.data(), target_.data(), source_.data(), diagonal_.data(), values_,
          inverse_.data(), z_.data(), p_.data(), lower_.data(), product_.data()};
}

bool MatrixSweeps::update(const BlockMatrix& matrix, int domain, const Deadline& deadline) {
  if (version_ != matrix.version || rows_.size() != matrix.columns()) build(matrix, domain);
  values_ = matrix.values.data();
  return find_pivots(deadline);
}

void MatrixSweeps::build(const BlockMatrix& matrix, int domain) {
  rows_.build(matrix, domain);
  version_ = matrix.version;
  const int n = rows_.size(), separators = rows_.domain_start.back();
  start_ = rows_.below_start;
  target_ = rows_.below_row;
  source_.resize(rows_.below_entry.size());
  diagonal_.resize(n);
  for (int i = 0; i < n; ++i) diagonal_[i] = rows_.source[rows_.diagonal(i)].block;
  for (size_t e = 0; e < source_.size(); ++e) {
    const DomainRows::Source& source = rows_.source[rows_.below_entry[e]];
    source_[e] = 2 * source.block + source.transposed;
  }
  std::vector<int> slot_of(n - separators, -1);
  slot_start_.assign(1, 0);
  slot_row_.clear();
  for (int d = 0; d < rows_.domains(); ++d) {
    for (int e = start_[rows_.domain_start[d]]; e < start_[rows_.domain_start[d + 1]]; ++e) {
      if (target_[e] < separators) continue;
      int& slot = slot_of[target_[e] - separators];
      if (slot < slot_start_.back()) {
        slot = static_cast<int>(slot_row_.size());
        slot_row_.push_back(target_[e]);
      }
      target_[e] = n + slot;
    }
    slot_start_.push_back(static_cast<int>(slot_row_.size()));
  }
  later_start_.assign(n - separators + 1, 0);
  for (const int row : slot_row_) ++later_start_[row - separators + 1];
  for (int i = 0; i < n - separators; ++i) later_start_[i + 1] += later_start_[i];
  later_slot_.resize(slot_row_.size());
  auto next = later_start_;
  for (size_t s = 0; s < slot_row_.size(); ++s) later_slot_[next[slot_row_[s] - separators]++] = n + static_cast<int>(s);
  inverse_.resize(9 * static_cast<size_t>(n));
  const size_t size = 4 * (static_cast<size_t>(n) + slot_row_.size());
  for (auto* numbers : {&z_, &p_, &lower_, &product_}) numbers->assign(size, 0.0);
}

template <class Body>
double MatrixSweeps::sum_over_parts(const std::vector<int>& start, const Body& body) {
  const int domains = static_cast<int>(start.size()) - 1;
  partial_.assign(domains, 0.0);
  for_each(domains, [&](int d) { partial_[d] = body(d, start[d], start[d + 1]); }, 1);
  double sum = 0;
  for (const double part : partial_) sum += part;
  return sum;
}

template <int width>
void MatrixSweeps::collect(int first, int last, std::vector<double>& sums) const {
  const int separators = rows_.domain_start.back();
  for (int i = first; i < last; ++i)
    for (int l = later_start_[i - separators]; l < later_start_[i - separators + 1]; ++l) {
      double* const from = sums.data() + width * static_cast<std::ptrdiff_t>(later_slot_[l]);
      double* const to = sums.data() + width * static_cast<std::ptrdiff_t>(i);
      for (int d = 0; d < width; ++d) to[d] += std::exchange(from[d], 0.0);
    }
}

bool MatrixSweeps::find_pivots(const Deadline& deadline) {
  std::vector<double> updates(9 * (static_cast<size_t>(rows_.size()) + slot_row_.size()), 0.0);
  std::atomic<bool> definite = true, late = false;
  const View at = view();
  const auto eliminate = [&](int first, int last) {
    for (int i = first; i < last && definite && !late; ++i) {
      if ((i - first) % rows_per_look == 0 && deadline.passed()) late = true;
      if (!invert_pivot(row9(at.values, at.diagonal[i]), row9(updates.data(), i), row9(inverse_.data(), i))) definite = false;
      for (int e = at.start[i]; e < at.start[i + 1]; ++e) {
        Mat3 turned;
        const double* l = at.block(e);
        if (at.turned(e)) [[unlikely]] turned = Eigen::Map<const Mat3>(l).transpose(), l = turned.data();
        double* const to = row9(updates.data(), at.target[e]);
        BlockLanes sum(to);
        sum += BlockLanes(l).times_transposed(row9(inverse_.data(), i)).times_transposed(l);  // the inverse is symmetric
        sum.store(to);
      }
    }
  };
  sum_over_parts(rows_.domain_start, [&](int, int first, int last) { return eliminate(first, last), 0.0; });
  sum_over_parts(rows_.group_start, [&](int, int first, int last) {
    collect<9>(first, last, updates);
    return eliminate(first, last), 0.0;
  });
  if (late) throw OutOfTime();
  return definite;
}

void MatrixSweeps::begin() {
  std::fill(p_.begin(), p_.end(), 0.0);
  std::fill(lower_.begin(), lower_.end(), 0.0);
  std::fill(product_.begin(), product_.end(), 0.0);
}

double MatrixSweeps::forward_rows(int first, int last, double step, VecX& x_of_vertex, VecX& r_of_vertex) {
  const View at = view();
  double* const x = x_of_vertex.data();
  double* const r = r_of_vertex.data();
  Lanes sum{};
  for (int i = first; i < last; ++i) {
    const std::ptrdiff_t v = 3 * static_cast<std::ptrdiff_t>(at.vertex[i]);
    const Lanes residual = load3(r + v) - step * load4(row4(at.product, i));
    store3(residual, r + v);
    store3(load3(x + v) + step * load4(row4(at.p, i)), x + v);
    store4(Lanes{}, row4(at.product, i));
    const BlockLanes inverse(row9(at.inverse, i));
    const Lanes lower = load4(row4(at.lower, i));
    // The second product depends on the row before.
    const Lanes half = inverse.times(residual) - inverse.times(lower);
    store4(Lanes{}, row4(at.lower, i));
    store4(half, row4(at.z, i));
    sum += half * (residual - lower);
    for (int e = at.start[i]; e < at.start[i + 1]; ++e) {
      double* const to = row4(at.lower, at.target[e]);
      const BlockLanes l(at.block(e));
      if (at.turned(e)) [[unlikely]] store4(load4(to) + l.transposed_times(half), to);
      else store4(l.times(half, load4(to)), to);
    }
  }
  return sum3(sum);
}

template <bool multiply>
double MatrixSweeps::backward_rows(int first, int last, double ratio, const VecX* more) {
  const View at = view();
  Lanes sum{};
  for (int i = last - 1; i >= first; --i) {
    TransposedSum above, above_p;
    Lanes turned_above{}, turned_above_p{};
    const int begin = at.start[i], end = at.start[i + 1];
    for (int e = end - 1; e >= begin; --e) {  // the row solved last comes last
      const BlockLanes l(at.block(e));
      const Lanes z = load4(row4(at.z, at.target[e])), p = load4(row4(at.p, at.target[e]));
      if (at.turned(e)) [[unlikely]] {
        turned_above += l.times(z);
        if (multiply) turned_above_p += l.times(p);
      } else {
        above.add(l, z);
        if (multiply) above_p.add(l, p);
      }
    }
    const Lanes z = load4(row4(at.z, i)) - BlockLanes(row9(at.inverse, i)).times(above.sum() + turned_above);
    store4(z, row4(at.z, i));
    if (!multiply) continue;
    const Lanes p = z + load3(more->data() + 3 * static_cast<std::ptrdiff_t>(at.vertex[i])) + ratio * load4(row4(at.p, i));
    store4(p, row4(at.p, i));
    const Lanes upper = above_p.sum() + turned_above_p;
    const Lanes own = BlockLanes(row9(at.values, at.diagonal[i])).times(p);
    sum += p * (own + 2 * upper);
    store4(load4(row4(at.product, i)) + own + upper, row4(at.product, i));
    for (int e = begin; e < end; ++e) {
      double* const to = row4(at.product, at.target[e]);
      const BlockLanes l(at.block(e));
      if (at.turned(e)) [[unlikely]] store4(load4(to) + l.transposed_times(p), to);
      else store4(l.times(p, load4(to)), to);
    }
  }
  return sum3(sum);
}

// Copies the values of separator rows to their slots of a domain.
void MatrixSweeps::lend(int domain) {
  for (int s = slot_start_[domain]; s < slot_start_[domain + 1]; ++s) {
    store4(load4(row4(z_.data(), slot_row_[s])), row4(z_.data(), rows_.size() + s));
    store4(load4(row4(p_.data(), slot_row_[s])), row4(p_.data(), rows_.size() + s));
  }
}

double MatrixSweeps::forward(double step, VecX& x, VecX& r) {
  const double inside = sum_over_parts(rows_.domain_start, [&](int, int first, int last) { return forward_rows(first, last, step, x, r); });
  return inside + sum_over_parts(rows_.group_start, [&](int, int first, int last) {
    collect<4>(first, last, lower_);
    collect<4>(first, last, product_);
    return forward_rows(first, last, step, x, r);
  });
}

template <bool multiply>
double MatrixSweeps::backward_parts(double ratio, const VecX* more) {
  const double between = sum_over_parts(
      rows_.group_start, [&](int, int first, int last) { return backward_rows<multiply>(first, last, ratio, more); });
  return between + sum_over_parts(rows_.domain_start, [&](int d, int first, int last) {
    lend(d);
    return backward_rows<multiply>(first, last, ratio, more);
  });
}

double MatrixSweeps::backward(double ratio, const VecX& more) { return backward_parts<true>(ratio, &more); }

void MatrixSweeps::backward(VecX& z) {
  backward_parts<false>(0, nullptr);
  z.resize(3 * static_cast<Eigen::Index>(rows_.size()));
  for_each(rows_.size(), [&](int i) { store3(load4(row4(z_.data(), i)), z.data() + 3 * static_cast<std::ptrdiff_t>(rows_.vertex[i])); }, 1024);
}

}  // namespace tack
