// Incomplete Cholesky factorisation without fill, IC(0), on 3x3 blocks (Meijerink and van der Vorst
// 1977); domains run in parallel, then their separators. If a pivot is indefinite, factorisation
// restarts with a larger multiple of the diagonal blocks added (Manteuffel 1980); large systems
// start with the final multiple of the last system. The factor is stored in single precision:
// applying it takes as long as reading it.
#include <Eigen/Cholesky>

#include <atomic>

#include "framework/config/field.hpp"
#include "framework/core/lanes.hpp"
#include "geometry/parallel.hpp"
#include "solvers/linear/domain_rows.hpp"
#include "solvers/linear/preconditioner.hpp"

namespace tack {

class IncompleteCholesky : public Preconditioner {
 public:
  void fields(Fields& f) override {
    f.integer("domain", domain_, "smallest number of vertices of a domain, the unit of work of a thread").at_least(1);
  }

  bool update(const BlockMatrix& matrix, const Deadline& deadline) override {
    if (version_ != matrix.version || rows_.size() != matrix.columns()) {
      rows_.build(matrix, domain_);
      version_ = matrix.version;
      exact_.resize(matrix.values.size() + 1);
      lower_.resize(matrix.values.size() + 1);
      upper_.resize(matrix.values.size() + 1);
    }
    const bool as_before = rows_.size() >= many && rows_.size() == kept_size_;
    const int systems = as_before ? systems_ + 1 : 0;
    const double kept = as_before ? kept_shift_ : 0, first = systems % systems_per_look > 0 ? kept : kept / larger;
    kept_size_ = 0;  // unless this factorisation succeeds: the deadline may pass
    for (double shift = first < smallest_shift ? 0 : first; shift < largest_shift; shift = std::max(larger * shift, smallest_shift))
      if (factorize(matrix, shift, deadline)) {
        for_each(rows_.size(), [&](int i) { round(i); }, 512);
        kept_size_ = rows_.size();
        kept_shift_ = shift;
        systems_ = systems;
        return true;
      }
    return false;
  }

  void apply(const VecX& r, VecX& z) override {
    x_.resize(stride * std::ptrdiff_t(rows_.size()));
    z.resize(r.size());
    const auto forward = [&](int first, int last) {
      for (int i = first; i < last; ++i) store4(load3(r.data() + 3 * std::ptrdiff_t(rows_.vertex[i])), values_of(i));
      for (int i = first; i < last; ++i) solve_lower(i);
    };
    const auto backward = [&](int first, int last) {
      for (int i = last - 1; i >= first; --i) solve_upper(i);
      for (int i = first; i < last; ++i) store3(load4(values_of(i)), z.data() + 3 * std::ptrdiff_t(rows_.vertex[i]));
    };
    for_each_part(rows_.domain_start, forward);
    for_each_part(rows_.group_start, [&](int first, int last) {
      forward(first, last);
      backward(first, last);
    });
    for_each_part(rows_.domain_start, backward);
  }

 private:
  static constexpr int stride = 4;  // numbers of x_ per row

  template <class Body>
  static void for_each_part(const std::vector<int>& start, const Body& body) {
    for_each(static_cast<int>(start.size()) - 1, [&](int d) { body(start[d], start[d + 1]); }, 1);
  }
  double* exact(int k) { return exact_.data() + 9 * std::ptrdiff_t(k); }
  double* values_of(int row) { return x_.data() + stride * std::ptrdiff_t(row); }
  // Returns row i of the transposed factor: its diagonal block, then the others.
  float* upper(int i) { return upper_.data() + 9 * (std::ptrdiff_t(rows_.below_start[i]) + i); }

  bool factorize(const BlockMatrix& matrix, double shift, const Deadline& deadline) {
    std::atomic<bool> definite = true, late = false;
    const auto rows = [&](int first, int last) {
      for (int i = first; i < last && definite && !late; ++i) {
        if ((i - first) % rows_per_look == 0 && deadline.passed()) late = true;
        else if (!eliminate(i, matrix, shift)) definite = false;
      }
    };
    for_each_part(rows_.domain_start, rows);
    for_each_part(rows_.group_start, rows);
    if (late) throw OutOfTime();
    return definite;
  }

  // Computes row i of L, with the inverse of its diagonal block. Returns false if the block is not
  // positive definite.
  bool eliminate(int i, const BlockMatrix& matrix, double shift) {
    const std::vector<int>& column = rows_.column;
    const int first = rows_.row_start[i], diagonal = rows_.diagonal(i);
    Mat3 pivot = (1 + shift) * matrix.block(rows_.source[diagonal].block);
    const Vec3 scale = pivot.diagonal();
    BlockLanes rest(pivot.data());
    for (int k = first; k < diagonal; ++k) {
      const auto source = matrix.block(rows_.source[k].block);
      const Mat3 start = rows_.source[k].transposed ? Mat3(source.transpose()) : Mat3(source);
      BlockLanes sum(start.data());
      const int row = column[k], end = rows_.diagonal(row);
      int mine = first, other = rows_.row_start[row];
      while (mine < k && other < end) {  // columns that both rows have
        const int a = column[mine], b = column[other];
        if (a == b) sum -= BlockLanes::padded(exact(mine)).times_transposed(exact(other));
        mine += a <= b;
        other += b <= a;
      }
      sum = sum.times_transposed(exact(end));
      sum.store(exact(k));
      rest -= sum.times_transposed(exact(k));
    }
    rest.store(pivot.data());
    const Eigen::LLT<Mat3> root(pivot);
    if (root.info() != Eigen::Success) return false;
    if ((root.matrixLLT().diagonal().array().square() <= smallest_pivot * scale.array()).any()) return false;
    Eigen::Map<Mat3> inverse(exact(diagonal));
    inverse = root.matrixL().solve(Mat3::Identity());
    return true;
  }

  // Rounds row i of L and of L^T to single precision.
  void round(int i) {
    const int first = rows_.row_start[i], diagonal = rows_.diagonal(i);
    std::copy(exact(first), exact(diagonal + 1), lower_.data() + 9 * std::ptrdiff_t(first));
    float* to = upper(i);
    const auto transpose = [&](int entry) {
      Eigen::Map<Eigen::Matrix3f> block(to);
      block = Eigen::Map<const Mat3>(exact(entry)).transpose().cast<float>();
      to += 9;
    };
    transpose(diagonal);
    for (int k = rows_.below_start[i]; k < rows_.below_start[i + 1]; ++k) transpose(rows_.below_entry[k]);
  }

  // Solves row i of x <- L^-1 x.
  void solve_lower(int i) {
    const int diagonal = rows_.diagonal(i);
    const float* block = lower_.data() + 9 * std::ptrdiff_t(rows_.row_start[i]);
    Lanes sum = load4(values_of(i));
    for (int k = rows_.row_start[i]; k < diagonal; ++k, block += 9)
      sum -= BlockLanes::padded(block).times(values_of(rows_.column[k]));
    store4(sum, values_of(i));
    store4(BlockLanes::padded(block).times(values_of(i)), values_of(i));
  }

  // Solves row i of x <- L^-T x.
  void solve_upper(int i) {
    const float* const inverse = upper(i);
    const float* block = inverse;
    Lanes sum = load4(values_of(i));
    for (int k = rows_.below_start[i]; k < rows_.below_start[i + 1]; ++k)
      sum -= BlockLanes::padded(block += 9).times(values_of(rows_.below_row[k]));
    store4(sum, values_of(i));
    store4(BlockLanes::padded(inverse).times(values_of(i)), values_of(i));
  }

  static constexpr double smallest_pivot = 1e-10;  // relative to the diagonal of the matrix
  static constexpr int rows_per_look = 64;  // rows between checks of the deadline
  static constexpr double smallest_shift = 1e-3, largest_shift = 1e3, larger = 4;
  static constexpr int many = 5000;  // vertices from which a shift is stored for the next system
  static constexpr int systems_per_look = 8;  // systems between trials of a smaller shift

  int domain_ = 2000;
  DomainRows rows_;
  std::uint64_t version_ = 0;
  int kept_size_ = 0;      // vertices of the last system; 0: factorisation failed
  double kept_shift_ = 0;  // shift of the last system
  int systems_ = 0;        // consecutive systems of that size
  std::vector<double> exact_;         // blocks of L, by rows
  std::vector<float> lower_, upper_;  // blocks of L and of L^T, by rows
  VecX x_;                            // by rows
};

TACK_REGISTER(Preconditioner, IncompleteCholesky, "incomplete_cholesky",
              "Cholesky factor in the pattern of the matrix, shifted where it breaks down.",
              "Meijerink and van der Vorst 1977; Manteuffel 1980");

}  // namespace tack
