// The incremental potential of one step (the paper, eq. 1):
//     E(x) = 1/2 |x - x~|_M^2 + beta h^2 sum_i P_i(x),
// as a function of the unknowns q. Contact may have its own scale instead of beta h^2. Quasi-static
// steps have no inertia and a scale of 1.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "framework/assembly/assembler.hpp"
#include "framework/assembly/mixed_inertia.hpp"
#include "framework/core/objective.hpp"
#include "framework/core/term_values.hpp"

namespace tack {

/// Objective of a time step.
class IncrementalPotential : public Objective {
 public:
  // mass: lumped, per vertex [kg]. on_move: optional, called with every new configuration before
  // the terms are evaluated there (contact finds its active pairs).
  IncrementalPotential(std::vector<const Term*> terms, const DofMap& dofs, const VecX& mass,
                       PhaseClock& clock, std::function<void(const VecX& x)> on_move = {});

  /// Sets the masses from the next step on.
  void set_mass(const VecX& mass);

  /// Starts a step: prediction x~ (3n), scales beta h^2 (or 1), inertia on or off, and the
  /// configuration that holds the fixed vertices.
  void begin_step(const VecX& x_start, const VecX& prediction, const TermScales& scales,
                  bool inertia);

  /// What the step began with, for problems over a part of its unknowns.
  struct Settings {
    VecX mass, prediction;  // n [kg], 3n [m]
    TermScales scales;
    bool inertia = true;
  };
  const Settings& settings() const { return settings_; }
  long moves() const { return moves_; }  // changes of the configuration so far
  /// Returns the terms, without the inertia of mixed vertices.
  std::span<const Term* const> terms() const {
    return {terms_.data(), terms_.size() - (mixed_inertia_.empty() ? 0 : 1)};
  }

  const DofMap& dofs() const { return dofs_; }
  const VecX& configuration() const { return x_; }
  double scale() const { return scales_.body; }  // beta h^2, or 1
  /// Returns the value of a term at x if the first evaluation of the step was there; else nothing
  /// [J].
  std::optional<double> first_value(const Term* term, const VecX& x) const;
  /// Returns the gradient of all terms that store energy at x (3n) [N], fixed vertices included,
  /// linear terms excluded.
  VecX gradient_at_all_vertices(const VecX& x);
  /// Returns the largest component of any stencil force at the last evaluated gradient [N].
  double largest_stencil_force() const { return assembler_.largest_stencil_force(); }
  /// Forward to the assembler, with the stencil forces of that gradient.
  template <class Act>
  void for_each_stencil_force(const Act& act) const {
    assembler_.for_each_stencil_force(act);
  }
  template <class Act>
  void for_each_lasting_stencil(const Act& act) const {
    assembler_.for_each_lasting_stencil(act);
  }
  /// Returns the largest component of the inertial force of a block at the current point [N].
  double inertial_force(int block) const;

  int size() const override { return dofs_.size(); }
  void move_to(const VecX& q) override;
  double value() override;
  double value_noise() const override;
  const VecX& gradient() override;
  const BlockMatrix& hessian(const HessianRequest& request) override;
  LeastSquares least_squares() const override;
  std::vector<ObjectivePart> parts() const override;
  double part_value(int part) override;
  VecX part_gradient(int part) override;
  int value_count() const override { return value_count_; }

 private:
  double inertia_value() const;
  double value_of(const Term& term) const;
  void set_inertia_gradient(VecX& gradient) const;

  MixedInertia mixed_inertia_;  // of vertices that several unknowns move
  std::vector<const Term*> terms_;
  const DofMap& dofs_;
  VecX block_mass_, free_mass_;  // per block, of the vertices that it alone moves [kg]; block_mass_
                                 // is zero when quasi-static
  std::function<void(const VecX&)> on_move_;
  PhaseClock& clock_;
  Assembler assembler_;
  TermValues term_values_;  // of terms_

  VecX x_, prediction_, q_;
  TermScales scales_;
  bool inertia_ = true;
  Settings settings_;
  long moves_ = 0;
  double value_ = 0, noise_ = 0;
  bool value_known_ = false, gradient_known_ = false;
  int value_count_ = 0;
  VecX first_x_;                      // of the first evaluation of the step; empty before it
  std::vector<double> first_values_;  // per term
  VecX gradient_;
  BlockMatrix matrix_;
};

}  // namespace tack
