// Assembler: sums the terms of the potential into one gradient and one block matrix. Every stencil
// writes its own slots, and one gather sums the slots of each target. Hessians of ranged terms are
// summed by chunks first (local_sums.hpp). The gather maps of static terms are built once, those of
// dynamic terms whenever their stencils have changed.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "framework/assembly/gather_map.hpp"
#include "framework/assembly/local_sums.hpp"
#include "framework/assembly/reduced_stencils.hpp"
#include "framework/assembly/term_scales.hpp"
#include "framework/core/objective.hpp"
#include "framework/core/phase_clock.hpp"
#include "geometry/parallel.hpp"

namespace tack {

/// Sums terms into a gradient and a block matrix.
class Assembler {
 public:
  Assembler(std::vector<const Term*> terms, const DofMap& dofs, PhaseClock& clock);

  /// Adds scales * gradients of the terms to `gradient`, in the unknowns (3m).
  void add_gradient(const VecX& x, const TermScales& scales, VecX& gradient);

  /// Adds scales * gradients to `gradient`; matrix <- scales * Hessians + diag(block_mass), as
  /// requested.
  void assemble(const VecX& x, const TermScales& scales, const HessianRequest& request,
                const VecX& block_mass, VecX& gradient, BlockMatrix& matrix);

  /// Adds the stencil gradients of the last evaluation, of terms that store energy, at all
  /// vertices, fixed ones included (3n) [N].
  void add_last_gradients(VecX& gradient) const;

  /// Returns the largest component of any stencil force at the last evaluation [N].
  double largest_stencil_force() const;
  /// Calls act(vertices, largest, dynamic) for each stencil of the last evaluation: its vertices,
  /// the largest component of its force [N], and whether its term is dynamic. Several threads call
  /// act at the same time, in any order.
  template <class Act>
  void for_each_stencil_force(const Act& act) const;
  /// Calls act(vertices) for each stencil of a term that is not dynamic, one after the other.
  template <class Act>
  void for_each_lasting_stencil(const Act& act) const;

 private:
  struct Group {
    std::vector<const Term*> terms;
    std::vector<PlacedBatch> batches;
    std::vector<const Term*> batch_terms;               // the term of each batch
    std::vector<int> first_gradient, first_hessian;     // per term
    std::vector<double> gradient_slots, hessian_slots;  // of the stencils, then of the reduced ones
    size_t own_gradient_slots = 0;
    ReducedStencils reduced;
    GatherMap gradient_map, hessian_map;
    // The batches that the maps are for: arity, count and vertices of each
    std::vector<int> mapped;
    bool hessian_mapped = false;  // whether the Hessian's map is made too

    double largest_force() const;
    template <class Act>
    void for_each_batch(const Act& act) const;
    bool is_mapped() const;
    void set_mapped();
    void assign_slots(const DofMap& dofs, bool with_hessian);
    void evaluate(const VecX& x, Projection projection, bool with_hessian, TermTimes* times);
    void clamp_at(const std::vector<char>& block, const DofMap& dofs);
    std::vector<PlacedBatch> mapped_batches() const;
    void gather_gradient(double scale, VecX& gradient) const;
    void gather_hessian(double scale, const std::vector<int>& positions, BlockMatrix& matrix) const;
  };

  std::vector<Group*> groups() { return {&ranged_, &static_, &dynamic_}; }
  void evaluate_ranged(const VecX& x, const HessianRequest* hessian);
  void number_components();
  void locate_static_blocks();
  void add_linear(const VecX& x, const TermScales& scales, VecX& gradient) const;
  void gather_modes(const VecX& x, const TermScales& scales, const HessianRequest& request,
                    GlobalModes& modes) const;
  void project_out_fixed_directions(BlockMatrix& matrix) const;

  const DofMap& dofs_;
  PhaseClock& clock_;
  std::vector<const Term*> terms_;
  Group ranged_;           // terms that give their lasting stencils by ranges,
  LocalSums ranged_sums_;  // and their Hessians
  std::vector<std::pair<const Term*, const GlobalModeSource*>> mode_sources_;
  Group static_, dynamic_;
  std::unique_ptr<BlockPattern> pattern_;
  std::vector<int> component_;                  // of each unknown block, see BlockMatrix
  std::vector<int> ranged_keys_, static_keys_;  // of the pattern: the key of each target of either
  std::vector<int> ranged_positions_, static_positions_, dynamic_positions_;  // in the matrix
};

/// Calls act(arity, count, vertices, slots) for each batch. `vertices` are those at the time when
/// the slots were placed; a dynamic term may have other stencils by now.
template <class Act>
void Assembler::Group::for_each_batch(const Act& act) const {
  const double* slots = gradient_slots.data();
  for (size_t i = 0; i < mapped.size();) {
    const int arity = mapped[i], count = mapped[i + 1];
    act(arity, count, mapped.data() + i + 2, slots);
    const auto entries = static_cast<size_t>(arity) * count;
    i += 2 + entries;
    slots += 3 * entries;
  }
}

template <class Act>
void Assembler::for_each_stencil_force(const Act& act) const {
  for (const Group* group : {&ranged_, &static_, &dynamic_})
    group->for_each_batch([&](int arity, int count, const int* vertices, const double* slots) {
      for_each(count, [&, dynamic = group == &dynamic_](int s) {
        const auto first = static_cast<size_t>(arity) * s;
        const Eigen::Map<const VecX> force(slots + 3 * first, 3 * arity);
        const double largest = force.lpNorm<Eigen::Infinity>();
        act(std::span<const int>(vertices + first, arity), largest, dynamic);
      });
    });
}

template <class Act>
void Assembler::for_each_lasting_stencil(const Act& act) const {
  for (const Group* group : {&ranged_, &static_})
    group->for_each_batch([&](int arity, int count, const int* vertices, const double*) {
      for (int s = 0; s < count; ++s)
        act(std::span<const int>(vertices + static_cast<size_t>(arity) * s, arity));
    });
}

}  // namespace tack
