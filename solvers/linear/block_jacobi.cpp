// Block Jacobi: the inverses of the 3x3 blocks on the diagonal.
#include "geometry/parallel.hpp"
#include "solvers/linear/inverse_blocks.hpp"
#include "solvers/linear/preconditioner.hpp"

namespace tack {

class BlockJacobi : public Preconditioner {
 public:
  bool update(const BlockMatrix& matrix, const Deadline&) override {
    inverse_.resize(matrix.columns());
    return min_chunks(matrix.columns(), 1, [&](int first, int last) {
      bool definite = true;
      for (int c = first; c < last; ++c)
        definite &= invert_definite(matrix.block(matrix.column_start[c]), inverse_[c]);
      return definite ? 1.0 : 0.0;
    }) > 0;
  }

  void apply(const VecX& r, VecX& z) override {
    z.resize(r.size());
    for_each(static_cast<int>(inverse_.size()), [&](int c) {
      z.segment<3>(3 * c) = inverse_[c] * r.segment<3>(3 * c);
    }, 1024);
  }

 private:
  std::vector<Mat3> inverse_;
};

TACK_REGISTER(Preconditioner, BlockJacobi, "block_jacobi",
              "Inverses of the 3x3 blocks on the diagonal: cheap, for well-conditioned systems.",
              "Saad 2003, Iterative Methods for Sparse Linear Systems, 10.2");

}  // namespace tack
