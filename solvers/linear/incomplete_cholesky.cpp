// Incomplete Cholesky factorisation without fill, IC(0), on 3x3 blocks in the order of the mesh
// (Meijerink and van der Vorst 1977). Threads take tiles of rows and wait for those that a tile
// depends on (row_tiles.hpp). If a pivot is indefinite, factorisation restarts with a larger
// multiple of the diagonal blocks added (Manteuffel 1980); large systems start with the final
// multiple of the last system. The factor is stored in single precision: applying it takes as long
// as reading it.
#include <Eigen/Cholesky>

#include <atomic>

#include "framework/config/field.hpp"
#include "framework/core/lanes.hpp"
#include "geometry/ordered_loop.hpp"
#include "geometry/parallel.hpp"
#include "geometry/unset_array.hpp"
#include "solvers/linear/lower_rows.hpp"
#include "solvers/linear/preconditioner.hpp"
#include "solvers/linear/row_tiles.hpp"

namespace tack {

class IncompleteCholesky : public Preconditioner {
 public:
  void fields(Fields& f) override {
    f.optional_integer("domain", former_domain_, "without effect: all threads share one domain").at_least(1).deprecated("leave it out; it has no effect, because all threads share one domain");
  }

  bool update(const BlockMatrix& matrix, const Deadline& deadline) override {
    if (version_ != matrix.version || rows_.size() != matrix.columns()) {
      rows_.build(matrix);
      const RowTiles tiles(rows_);
      tile_start_ = tiles.start;
      loop_.reset(tiles.order());
      version_ = matrix.version;
      column_start_ = matrix.column_start;
      row_ = matrix.row;
      const size_t numbers = matrix.values.size();
      exact_.resize(numbers + 1);  // padded blocks are read with the number that follows
      lower_.resize(numbers + 1);
      upper_.resize(numbers + 1);
      exact_.data()[numbers] = 0, lower_.data()[numbers] = 0, upper_.data()[numbers] = 0;
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
    const int tiles = tile_count();
    loop_.run(2 * tiles, [&](int chunk) {
      if (chunk < tiles)
        for (int i = tile_start_[chunk]; i < tile_start_[chunk + 1]; ++i) solve_lower(i, r);
      else
        for (int i = tile_start_[2 * tiles - chunk] - 1; i >= tile_start_[2 * tiles - 1 - chunk]; --i) solve_upper(i, z);
    });
  }

 private:
  static constexpr int stride = 4;  // numbers of x_ per row

  int tile_count() const { return static_cast<int>(tile_start_.size()) - 1; }
  double* exact(int k) { return exact_.data() + 9 * std::ptrdiff_t(k); }
  float* upper(int block) { return upper_.data() + 9 * std::ptrdiff_t(block); }
  double* values_of(int row) { return x_.data() + stride * std::ptrdiff_t(row); }

  bool factorize(const BlockMatrix& matrix, double shift, const Deadline& deadline) {
    std::atomic<bool> definite = true, late = false;
    loop_.run(tile_count(), [&](int t) {
      if (deadline.passed()) late = true;
      for (int i = tile_start_[t]; i < tile_start_[t + 1] && definite && !late; ++i)
        if (!eliminate(i, matrix, shift)) definite = false;
    });
    if (late) throw OutOfTime();
    return definite;
  }

  // Computes row i of L, with the inverse of its diagonal block. Returns false if the block is not
  // positive definite.
  bool eliminate(int i, const BlockMatrix& matrix, double shift) {
    const std::vector<int>& column = rows_.column;
    const int first = rows_.row_start[i], diagonal = rows_.diagonal(i);
    Mat3 pivot = (1 + shift) * matrix.block(rows_.block[diagonal]);
    const Vec3 scale = pivot.diagonal();
    BlockLanes rest(pivot.data());
    for (int k = first; k < diagonal; ++k) {
      BlockLanes sum(matrix.values.data() + 9 * std::ptrdiff_t(rows_.block[k]));
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

  // Rounds row i of L and column i, which is row i of L^T, to single precision.
  void round(int i) {
    const int first = rows_.row_start[i], diagonal = rows_.diagonal(i);
    std::copy(exact(first), exact(diagonal + 1), lower_.data() + 9 * std::ptrdiff_t(first));
    float* to = upper(column_start_[i]);
    for (int k = column_start_[i]; k < column_start_[i + 1]; ++k, to += 9) {
      Eigen::Map<Eigen::Matrix3f> block(to);
      block = Eigen::Map<const Mat3>(exact(rows_.entry[k])).transpose().cast<float>();
    }
  }

  // Solves row i of x <- L^-1 r.
  void solve_lower(int i, const VecX& r) {
    const int diagonal = rows_.diagonal(i);
    const float* block = lower_.data() + 9 * std::ptrdiff_t(rows_.row_start[i]);
    Lanes sum = load3(r.data() + 3 * std::ptrdiff_t(i));
    for (int k = rows_.row_start[i]; k < diagonal; ++k, block += 9)
      sum -= BlockLanes::padded(block).times(values_of(rows_.column[k]));
    store4(BlockLanes::padded(block).times(sum), values_of(i));
  }

  // Solves row i of z <- L^-T x.
  void solve_upper(int i, VecX& z) {
    const float* const inverse = upper(column_start_[i]);
    const float* block = inverse;
    Lanes sum = load4(values_of(i));
    for (int k = column_start_[i] + 1; k < column_start_[i + 1]; ++k)
      sum -= BlockLanes::padded(block += 9).times(values_of(row_[k]));
    const Lanes solved = BlockLanes::padded(inverse).times(sum);
    store4(solved, values_of(i));
    store3(solved, z.data() + 3 * std::ptrdiff_t(i));
  }

  static constexpr double smallest_pivot = 1e-10;  // relative to the diagonal of the matrix
  static constexpr double smallest_shift = 1e-3, largest_shift = 1e3, larger = 4;
  static constexpr int many = 5000;  // vertices from which a shift is stored for the next system
  static constexpr int systems_per_look = 8;  // systems between trials of a smaller shift

  LowerRows rows_;
  std::vector<int> column_start_, row_;  // of the matrix
  std::vector<int> tile_start_;          // first row of each tile, and the end
  OrderedLoop loop_;                     // over tiles forwards, then backwards
  std::optional<int> former_domain_;  // of stored steps and scenes that name it
  std::uint64_t version_ = 0;
  int kept_size_ = 0;      // vertices of the last system; 0: factorisation failed
  double kept_shift_ = 0;  // shift of the last system
  int systems_ = 0;        // consecutive systems of that size
  UnsetArray<double> exact_;        // blocks of L, by rows
  UnsetArray<float> lower_;         // blocks of L, by rows
  UnsetArray<float> upper_;         // blocks of L^T, in the order of the matrix
  VecX x_;                            // four numbers per row
};

TACK_REGISTER(Preconditioner, IncompleteCholesky, "incomplete_cholesky",
              "Cholesky factor in the pattern of the matrix, shifted where it breaks down.",
              "Meijerink and van der Vorst 1977; Manteuffel 1980");

}  // namespace tack
