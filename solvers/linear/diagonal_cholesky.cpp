// The sweeps of matrix_sweeps.hpp as a preconditioner.
#include "framework/config/field.hpp"
#include "solvers/linear/matrix_sweeps.hpp"
#include "solvers/linear/preconditioner.hpp"

namespace tack {

class DiagonalCholesky : public Preconditioner {
 public:
  void fields(Fields& f) override {
    f.integer("domain", domain_, "smallest number of vertices of a domain, the unit of work of a thread").at_least(1);
  }
  bool update(const BlockMatrix& matrix, const Deadline& deadline) override { return sweeps_.update(matrix, domain_, deadline); }
  void apply(const VecX& r, VecX& z) override {
    rest_ = r;
    sweeps_.begin();
    none_.setZero(r.size());
    sweeps_.forward(0, none_, rest_);
    sweeps_.backward(z);
  }
  MatrixSweeps* sweeps() override { return &sweeps_; }

 private:
  int domain_ = 2000;
  MatrixSweeps sweeps_;
  VecX rest_, none_;
};

TACK_REGISTER(Preconditioner, DiagonalCholesky, "diagonal_cholesky",
              "Incomplete Cholesky factor that changes only the diagonal: no factor is computed or read.",
              "Pommerell 1992 (D-ILU); Eisenstat 1981");

}  // namespace tack
