// Incomplete Cholesky factorisation without fill, IC(0), on 3x3 blocks (Meijerink and van der Vorst
// 1977), domains side by side and then what separates them. Where a pivot turns indefinite, it starts
// again with a larger multiple of the diagonal blocks added (Manteuffel 1980). The factor is stored in
// single precision: applying it takes as long as reading it.
#include <Eigen/Cholesky>

#include <atomic>

#include "framework/assembly/parallel.hpp"
#include "framework/config/field.hpp"
#include "framework/core/lanes.hpp"
#include "solvers/linear/domain_rows.hpp"
#include "solvers/linear/preconditioner.hpp"

namespace tack {

class IncompleteCholesky : public Preconditioner {
 public:
  void fields(Fields& f) override {
    f.integer("domain", domain_, "vertices of a domain, the unit of work of a thread").at_least(1);
  }

  bool update(const BlockMatrix& matrix, const Deadline& deadline) override {
    if (version_ != matrix.version || rows_.size() != matrix.columns()) {
      rows_.build(matrix, domain_);
      version_ = matrix.version;
      exact_.resize(matrix.values.size());
      factor_.resize(matrix.values.size());
    }
    for (double shift = 0; shift < largest_shift; shift = std::max(4 * shift, smallest_shift))
      if (factorize(matrix, shift, deadline)) {
        for_each_chunk(static_cast<int>(factor_.size()), [&](int, int first, int last) {
          std::copy(exact_.begin() + first, exact_.begin() + last, factor_.begin() + first);
        }, 1 << 14);
        return true;
      }
    return false;
  }

  void apply(const VecX& r, VecX& z) override {
    x_.resize(r.size());
    z.resize(r.size());
    for_each_domain([&](int first, int last) {
      for (int i = first; i < last; ++i) x_.segment<3>(3 * i) = r.segment<3>(3 * rows_.vertex[i]);
      forward(first, last);
    });
    const int separators = rows_.separators();
    for (int i = separators; i < rows_.size(); ++i) x_.segment<3>(3 * i) = r.segment<3>(3 * rows_.vertex[i]);
    forward(separators, rows_.size());
    backward(separators, rows_.size());
    for (int i = separators; i < rows_.size(); ++i) z.segment<3>(3 * rows_.vertex[i]) = x_.segment<3>(3 * i);
    for_each_domain([&](int first, int last) {
      backward(first, last);
      for (int i = first; i < last; ++i) z.segment<3>(3 * rows_.vertex[i]) = x_.segment<3>(3 * i);
    });
  }

 private:
  template <class Body>
  void for_each_domain(const Body& body) {
    for_each(rows_.domains(), [&](int d) { body(rows_.domain_start[d], rows_.domain_start[d + 1]); }, 1);
  }
  Eigen::Map<Mat3> block(int k) { return Eigen::Map<Mat3>(exact_.data() + 9 * std::ptrdiff_t(k)); }
  const float* factor(int k) const { return factor_.data() + 9 * std::ptrdiff_t(k); }
  double* part(int row) { return x_.data() + 3 * std::ptrdiff_t(row); }

  bool factorize(const BlockMatrix& matrix, double shift, const Deadline& deadline) {
    std::atomic<bool> definite = true, late = false;
    const auto rows = [&](int first, int last) {
      for (int i = first; i < last && definite && !late; ++i) {
        if ((i - first) % rows_per_look == 0 && deadline.passed()) late = true;
        else if (!eliminate(i, matrix, shift)) definite = false;
      }
    };
    for_each_domain(rows);
    rows(rows_.separators(), rows_.size());
    if (late) throw OutOfTime();
    return definite;
  }

  // Row i of L, with the inverse of its diagonal block; false if that is not positive definite.
  bool eliminate(int i, const BlockMatrix& matrix, double shift) {
    const auto& entries = rows_.entries;
    const int first = rows_.row_start[i], diagonal = rows_.diagonal(i);
    Mat3 pivot = (1 + shift) * matrix.block(entries[diagonal].block);
    const Vec3 scale = pivot.diagonal();
    for (int k = first; k < diagonal; ++k) {
      const auto source = matrix.block(entries[k].block);
      Mat3 sum = entries[k].transposed ? Mat3(source.transpose()) : Mat3(source);
      const int row = entries[k].column, end = rows_.diagonal(row);
      int mine = first, other = rows_.row_start[row];
      while (mine < k && other < end) {  // the columns that both rows have
        const int a = entries[mine].column, b = entries[other].column;
        if (a == b) sum.noalias() -= block(mine) * block(other).transpose();
        mine += a <= b;
        other += b <= a;
      }
      block(k).noalias() = sum * block(end).transpose();
      pivot.noalias() -= block(k) * block(k).transpose();
    }
    const Eigen::LLT<Mat3> root(pivot);
    if (root.info() != Eigen::Success) return false;
    if ((root.matrixLLT().diagonal().array().square() <= smallest_pivot * scale.array()).any()) return false;
    block(diagonal) = root.matrixL().solve(Mat3::Identity());
    return true;
  }

  // x <- L^-1 x
  void forward(int first, int last) {
    for (int i = first; i < last; ++i) {
      const int diagonal = rows_.diagonal(i);
      Lanes sum = load3(part(i));
      for (int k = rows_.row_start[i]; k < diagonal; ++k)
        sum -= BlockLanes(factor(k)).times(part(rows_.entries[k].column));
      store3(sum, part(i));
      store3(BlockLanes(factor(diagonal)).times(part(i)), part(i));
    }
  }

  // x <- L^-T x
  void backward(int first, int last) {
    for (int i = last - 1; i >= first; --i) {
      const int diagonal = rows_.diagonal(i);
      const Lanes own = BlockLanes(factor(diagonal)).transposed_times(load3(part(i)));
      store3(own, part(i));
      for (int k = rows_.row_start[i]; k < diagonal; ++k) {
        double* to = part(rows_.entries[k].column);
        store3(load3(to) - BlockLanes(factor(k)).transposed_times(own), to);
      }
    }
  }

  static constexpr double smallest_pivot = 1e-10;  // relative to the diagonal of the matrix
  static constexpr int rows_per_look = 64;  // at the deadline
  static constexpr double smallest_shift = 1e-3, largest_shift = 1e3;

  int domain_ = 2000;
  DomainRows rows_;
  std::uint64_t version_ = 0;
  std::vector<double> exact_;  // blocks of L, by rows
  std::vector<float> factor_;  // the same
  VecX x_;                     // by rows
};

TACK_REGISTER(Preconditioner, IncompleteCholesky, "incomplete_cholesky",
              "Cholesky factor in the pattern of the matrix, shifted where it breaks down.",
              "Meijerink and van der Vorst 1977; Manteuffel 1980");

}  // namespace tack
