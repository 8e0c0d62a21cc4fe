// Preconditioned conjugate gradients. Memory and time of an iteration are proportional to the mesh
// size; the number of iterations grows with its fineness and, for a time step h, with h
// sqrt(stiffness / mass).
#include <limits>
#include <memory>

#include "framework/config/field.hpp"
#include "framework/core/linear_solver.hpp"
#include "framework/core/mode_update.hpp"
#include "solvers/linear/conjugate_gradients.hpp"
#include "solvers/linear/component_translations.hpp"
#include "solvers/linear/preconditioner.hpp"
#include "solvers/linear/rigid_motions.hpp"
#include "solvers/linear/swept_gradients.hpp"

namespace tack {

class Pcg : public LinearSolver {
 public:
  void fields(Fields& f) override {
    f.component("preconditioner", preconditioner_, "approximate inverse");
    f.number("tolerance", tolerance_, units::none,
             "residual of the system, relative, in the norm of the preconditioner").range(1e-14, 0.5);
    f.flag("translations", with_translations_,
           "add the translations of whole bodies to the preconditioner as a coarse space, so that these converge as well as the rest");
    f.flag("rigid_motions", with_rigid_motions_,
           "in systems of 5000 or more vertices that need more than a few iterations, also add the rigid motions of "
           "subdomains of bodies, so that the number of iterations hardly grows with the mesh");
    f.integer("max_iterations", max_iterations_, "iterations after which a system counts as unsolved")
        .at_least(1);
    f.flag("truncate", truncate_,
           "return the current iterate at negative curvature or after max_iterations, for inexact Newton methods; "
           "otherwise such a system counts as unsolved");
  }

  bool factorize(const BlockMatrix& matrix, PhaseClock& clock) override {
    const PhaseScope scope(clock, Phase::factorize);
    clock.count_factorization();
    matrix_ = &matrix;
    swept_.clear();
    if (!preconditioner_->update(matrix, clock.deadline())) return false;
    if (matrix.columns() != columns_) easy_ = 0;
    columns_ = matrix.columns();
    moved_rigidly_ = with_rigid_motions_ && columns_ >= many && easy_ < in_a_row && rigid_motions_.update(matrix, clock.deadline());
    if (with_translations_ && !moved_rigidly_) translations_.update(matrix);
    // The preconditioner must be positive definite even if the matrix is not; iterations detect the
    // latter.
    GlobalModes modes = matrix.modes;
    std::erase_if(modes, [](const GlobalMode& mode) { return mode.coefficient < 0; });
    return update_.prepare(modes, [&](const VecX& b, VecX& x) { precondition(b, x); });
  }

  void solve(const VecX& b, VecX& x, PhaseClock& clock) override {
    iterate(b, x, tolerance_, false, clock);
    if (moved_rigidly_) easy_ = iterations_ <= few ? easy_ + 1 : 0;
    else if (iterations_ > too_many) easy_ = 0;
  }
  void correct(const VecX& b, VecX& x, double relative, PhaseClock& clock) override { iterate(b, x, relative, true, clock); }

  void set_tolerance(double relative) override { tolerance_ = relative; }
  int iterations() const override { return iterations_; }
  int analyses() const override { return 0; }

 private:
  double add_motions(const VecX& r, VecX& z) { return moved_rigidly_ ? rigid_motions_.add(r, z) : with_translations_ ? translations_.add(r, z) : 0.0; }
  // Applies the preconditioner without global modes.
  void precondition(const VecX& r, VecX& z) {
    preconditioner_->apply(r, z);
    add_motions(r, z);
  }
  // going_on: b is the residual of the last solve.
  void iterate(const VecX& b, VecX& x, double relative, bool going_on, PhaseClock& clock) {
    const auto add = [&](const VecX& r, VecX& z) { return add_motions(r, z); };
    const ConjugateGradients::Goal goal{relative, max_iterations_};
    ConjugateGradients::Outcome outcome;
    // Sweeps act on the blocks, without global modes.
    if (MatrixSweeps* const sweeps = matrix_->modes.empty() ? preconditioner_->sweeps() : nullptr) {
      outcome = going_on && swept_.left(b) ? swept_.go_on(*sweeps, b, x, goal, clock, add) : swept_.solve(*sweeps, b, x, goal, clock, add);
      iterations_ = swept_.iterations();
    } else {
      outcome = cg_.solve(*matrix_, b, x, goal, clock, [&](const VecX& r, VecX& z) {
        precondition(r, z);
        update_.apply(z);
      });
      iterations_ = cg_.iterations();
    }
    const bool reached = truncate_ && iterations_ > 0;
    if (outcome != ConjugateGradients::Outcome::solved && !reached) x.setConstant(b.size(), std::numeric_limits<double>::quiet_NaN());
  }

  std::unique_ptr<Preconditioner> preconditioner_ = Registry<Preconditioner>::make("incomplete_cholesky");
  double tolerance_ = 1e-2;
  int max_iterations_ = 1000;
  bool truncate_ = false;
  bool with_translations_ = true, with_rigid_motions_ = true;
  // Vertices, below which iterations are few or a factor is cheap.
  static constexpr int many = 5000;
  ComponentTranslations translations_;
  // Iterations, and consecutive systems, below which rigid motions cost more than they save.
  static constexpr int few = 4, in_a_row = 4;
  static constexpr int too_many = 10;  // iterations without rigid motions, from which they are used
  int columns_ = 0, easy_ = 0;                 // vertices and easy systems so far
  RigidMotions rigid_motions_;
  bool moved_rigidly_ = false;  // the coarse space of the present system: rigid motions

  const BlockMatrix* matrix_ = nullptr;
  ConjugateGradients cg_;
  SweptGradients swept_;
  int iterations_ = 0;  // of the last solve
  ModeUpdate update_;  // correction of the preconditioner by global modes
};

TACK_REGISTER(LinearSolver, Pcg, "pcg",
              "Conjugate gradients with a preconditioner that is rebuilt for every system.",
              "Nocedal and Wright, Numerical Optimization, 5.1 (preconditioned conjugate gradients)");

}  // namespace tack
