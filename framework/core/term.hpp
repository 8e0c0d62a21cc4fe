// A term of the potential energy P(x) = sum_i P_i(x): a sum over small stencils of vertices.
// A term computes all its stencils in one (virtual) call; each stencil writes its own slots, and
// the assembler gathers the slots (framework/assembly). One virtual call per term, none per
// stencil.
//
// Slots of a stencil of arity K: gradient, K 3-vectors [N]; Hessian, K(K+1)/2 column-major 3x3
// blocks [N/m], lower triangle by rows: (0,0) (1,0) (1,1) (2,0) ...
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "framework/core/projection.hpp"
#include "framework/core/step_participant.hpp"
#include "geometry/types.hpp"

namespace tack {

struct StencilChoice;
class Records;
class ResidualView;

/// Function that receives the vertices of a stencil and an energy of that stencil [J].
using EnergyVisitor = std::function<void(std::span<const int> vertices, double joules)>;

inline constexpr int largest_arity = 10;     // vertices of a stencil
inline constexpr int largest_rank_one = 24;  // vertices of a stencil with a Hessian of rank one

/// Returns the number of Hessian blocks of a stencil.
constexpr int hessian_blocks(int arity) { return arity * (arity + 1) / 2; }

/// Stencils of one kind: stencil s touches vertices[arity * s + (0..arity-1)].
struct StencilBatch {
  int arity = 0;
  int count = 0;
  const int* vertices = nullptr;
  // The last `scalars` entries of each stencil are scalar dofs (rod/rod_frames.hpp), not positions.
  // A scalar dof is the first of three numbers.
  int scalars = 0;
  bool rank_one = false;  // every Hessian is c u u^T with a number c and a vector u
};

/// Optional access to a batch of lasting stencils in ranges. The assembler sums the Hessians of a
/// range before they leave the cache. Several threads call it, and value() of its term, at once.
class StencilRanges {
 public:
  // `first` is a multiple of this, and so is `last` but for the end of the batch.
  static constexpr int grain = 32;

  /// Writes the slots of the stencils first .. last - 1. The slots of `first` are at the beginning
  /// of `gradient` and `hessian`; a null `hessian` is not written.
  virtual void range_derivatives(const VecX& x, Projection projection, int first, int last,
                                 double* gradient, double* hessian) const = 0;

 protected:
  ~StencilRanges() = default;
};

/// A term of the potential energy.
class Term : public StepParticipant {
 public:
  explicit Term(std::string name) : name_(std::move(name)) {}
  const std::string& name() const { return name_; }

  /// Returns the energy at the configuration x (3n) [J].
  virtual double value(const VecX& x) const = 0;

  /// Returns the stencils, in the order of the slots; none for linear terms.
  virtual std::vector<StencilBatch> batches() const { return {}; }
  /// Returns true if the stencils may differ from one configuration to the next (contact).
  virtual bool dynamic() const { return false; }
  /// Returns true if the stencils of a dynamic term differ from one step or lagging iteration to
  /// the next, but not between the configurations of one.
  virtual bool lagged_stencils() const { return false; }

  /// Writes every gradient slot, and every Hessian slot unless `hessian` is null.
  virtual void derivatives(const VecX& x, Projection projection, double* gradient,
                           double* hessian) const;

  /// Returns the ranges of each batch; none if the term computes its stencils only all at once.
  virtual std::vector<const StencilRanges*> ranges() const { return {}; }

  /// Adds a gradient without slots (3n) [N]: that of a linear potential.
  virtual void add_linear_gradient(VecX& /*gradient*/) const {}

  /// Returns a term of the chosen stencils alone over the local vertices (local_stencils.hpp),
  /// equal to this one until the next begin_step or lag; a term without stencils: over all of
  /// these vertices. Its value may differ by a constant. Returns null if there is no such term:
  /// this one is then evaluated as a whole.
  virtual std::unique_ptr<Term> restricted(const StencilChoice& /*choice*/) const {
    return nullptr;
  }

  /// Returns the term as least squares (residual_view.hpp); null if it has no such form.
  virtual const ResidualView* residual_view() const { return nullptr; }

  /// Adds marks (DebondingMark, debonding.hpp) to the vertices (n) of every stencil that adheres at
  /// `from`: how far a motion to `to` (3n) takes its law. They bound the starting iterate of a step
  /// (predicted_motion.hpp), and the step (debonding_check.hpp). All participants are at `from`.
  virtual void mark_debonding(const VecX& /*from*/, const VecX& /*to*/,
                              std::vector<char>& /*marks*/) const {}

  /// Returns true if the value is a stored energy, false if it represents dissipation of a step.
  virtual bool stores() const { return true; }
  /// Calls visit(vertices, energy) for each stencil at x and returns true; the energies add up to
  /// the value. Returns false if the term does not offer it: the energy balance of groups of bodies
  /// (stepping/group_balance.hpp) then counts all stencils of the term as connected.
  virtual bool visit_energies(const VecX& /*x*/, const EnergyVisitor& /*visit*/) const {
    return false;
  }

  /// Adds the records of the term (records.hpp) once, when the world is built. The default adds the
  /// value as an energy under the name of the term.
  virtual void publish(Records& records) const;

 private:
  std::string name_;
};

inline void Term::derivatives(const VecX&, Projection, double*, double*) const {}

}  // namespace tack
