// Incomplete Cholesky factorisation without fill, IC(0), on 3x3 blocks (Meijerink and van der Vorst
// 1977). The columns are cut into domains of a fixed size, between which nothing is coupled: domains run
// in parallel, and the result does not depend on the number of threads. Where a pivot turns indefinite,
// the domain starts again with a larger multiple of its diagonal blocks added (Manteuffel 1980).
// The factor is stored in single precision: what it multiplies is memory.
#include <Eigen/Cholesky>

#include "framework/assembly/parallel.hpp"
#include "framework/config/field.hpp"
#include "framework/core/lanes.hpp"
#include "solvers/linear/preconditioner.hpp"

namespace tack {

class IncompleteCholesky : public Preconditioner {
 public:
  void fields(Fields& f) override {
    f.integer("domain", domain_, "vertices of a domain; couplings between domains are left out").at_least(1);
  }

  bool update(const BlockMatrix& matrix) override {
    matrix_ = &matrix;
    work_.resize(matrix.values.size());
    factor_.resize(matrix.values.size());
    return min_chunks(matrix.columns(), 1, [&](int first, int last) {
      for (double shift = 0; shift < largest_shift; shift = std::max(4 * shift, 1e-3))
        if (factorize(first, last, shift)) return 1.0;
      return 0.0;
    }, domain_) > 0;
  }

  void apply(const VecX& r, VecX& z) const override {
    z = r;
    for_each_chunk(matrix_->columns(), [&](int, int first, int last) {
      forward(first, last, z.data());
      backward(first, last, z.data());
    }, domain_);
  }

 private:
  Eigen::Map<Mat3> block(int k) { return Eigen::Map<Mat3>(work_.data() + 9 * std::ptrdiff_t(k)); }
  const float* factor(int k) const { return factor_.data() + 9 * std::ptrdiff_t(k); }

  // Columns [first, last): L with the inverses of its diagonal blocks; false at an indefinite pivot.
  bool factorize(int first, int last, double shift) {
    const auto& start = matrix_->column_start;
    std::copy(matrix_->values.begin() + 9 * std::ptrdiff_t(start[first]),
              matrix_->values.begin() + 9 * std::ptrdiff_t(start[last]),
              work_.begin() + 9 * std::ptrdiff_t(start[first]));
    for (int j = first; j < last; ++j) block(start[j]) *= 1 + shift;
    for (int j = first; j < last; ++j) {
      if (!eliminate(j, last)) return false;
    }
    std::copy(work_.begin() + 9 * std::ptrdiff_t(start[first]), work_.begin() + 9 * std::ptrdiff_t(start[last]),
              factor_.begin() + 9 * std::ptrdiff_t(start[first]));
    return true;
  }

  // Column j of L, and its updates of those to the right that are in the pattern.
  bool eliminate(int j, int last) {
    const auto& start = matrix_->column_start;
    const auto& row = matrix_->row;
    const Mat3 pivot = block(start[j]);
    const Eigen::LLT<Mat3> root(pivot);
    const Vec3 diagonal = matrix_->block(start[j]).diagonal();
    if (root.info() != Eigen::Success) return false;
    if ((root.matrixLLT().diagonal().array().square() < smallest_pivot * diagonal.array()).any()) return false;
    const Mat3 inverse = root.matrixL().solve(Mat3::Identity());
    block(start[j]) = inverse;
    for (int k = start[j] + 1; k < start[j + 1]; ++k) block(k) = (block(k) * inverse.transpose()).eval();
    for (int k = start[j] + 1; k < start[j + 1] && row[k] < last; ++k) {
      const Mat3 across = block(k).transpose();
      int to = start[row[k]];
      const int end = start[row[k] + 1];
      for (int below = k; below < start[j + 1]; ++below) {
        while (to < end && row[to] < row[below]) ++to;
        if (to == end) break;
        if (row[to] == row[below]) block(to).noalias() -= block(below) * across;
      }
    }
    return true;
  }

  // x <- L^-1 x
  void forward(int first, int last, double* x) const {
    for (int j = first; j < last; ++j) {
      int k = matrix_->column_start[j];
      double* own = x + 3 * std::ptrdiff_t(j);
      store3(BlockLanes(factor(k)).times(own), own);
      for (++k; k < matrix_->column_start[j + 1] && matrix_->row[k] < last; ++k) {
        double* to = x + 3 * std::ptrdiff_t(matrix_->row[k]);
        store3(load3(to) - BlockLanes(factor(k)).times(own), to);
      }
    }
  }

  // x <- L^-T x
  void backward(int first, int last, double* x) const {
    for (int j = last - 1; j >= first; --j) {
      const int diagonal = matrix_->column_start[j];
      double* own = x + 3 * std::ptrdiff_t(j);
      TransposedSum below, result;
      for (int k = diagonal + 1; k < matrix_->column_start[j + 1] && matrix_->row[k] < last; ++k)
        below.add(BlockLanes(factor(k)), load3(x + 3 * std::ptrdiff_t(matrix_->row[k])));
      result.add(BlockLanes(factor(diagonal)), load3(own) - below.sum());
      store3(result.sum(), own);
    }
  }

  static constexpr double smallest_pivot = 1e-10;  // relative to the diagonal of the matrix
  static constexpr double largest_shift = 1e3;

  int domain_ = 1000;
  const BlockMatrix* matrix_ = nullptr;
  std::vector<double> work_;
  std::vector<float> factor_;  // like the matrix's values
};

TACK_REGISTER(Preconditioner, IncompleteCholesky, "incomplete_cholesky",
              "Cholesky factor in the pattern of the matrix, by domains, shifted where it breaks down.",
              "Meijerink and van der Vorst 1977; Manteuffel 1980");

}  // namespace tack
