// Potential of a step over some blocks of its unknowns, the others held (Objective::restricted).
// It has a numbering of its own for the vertices of all stencils that these blocks move, and is an
// IncrementalPotential of parts of the terms (Term::restricted) over them: what it costs grows with
// the region and not with the world. Contact is searched among the candidates of the region
// (ContactPotential::local); a vertex that leaves its fat AABB has the world's candidates updated,
// and the parts made again. Terms without a restricted form are evaluated as a whole, and so is all
// of it where the contact model has no local search or a term of a plugin changes its stencils.
//
// Contact that subdivides triangles as others approach (deferred subdivision) does so in whole
// evaluations alone: there the potential may differ beyond the point of the others.
#pragma once

#include "framework/contact/contact_system.hpp"
#include "framework/contact/terms/local_contact.hpp"
#include "framework/core/local_stencils.hpp"
#include "framework/world/step_potential.hpp"

namespace tack {

class LocalPotential : public Objective {
 public:
  // blocks: ascending. The whole potential is where the others are held, and must outlive this.
  // Throws std::logic_error if another local potential of it exists, unless this one is one of
  // several that are `resumed` in turn.
  LocalPotential(StepPotential& whole, World& world, PhaseClock& clock, std::span<const int> blocks,
                 bool resumed = false);
  ~LocalPotential() override;

  const VecX& start() const { return start_; }  // the unknowns of the blocks, initially
  // Moves this potential to where the whole one was moved, or those that are resumed in turn have
  // gone since then. Returns the unknowns of the blocks there.
  const VecX& resume();
  const std::vector<int>& vertices_of_blocks() const { return owners_; }  // global, one per block
  // Calls act(x, p, moved) with the configuration and the displacements of all vertices (3n) for
  // unknowns q and a direction p of the blocks; moved: the vertices that these move, ascending.
  template <class Act>
  auto along(const VecX& q, const VecX& p, const Act& act) {
    place(q);
    displace(p);
    auto answer = act(scratch_.x, scratch_.p, std::span<const int>(moved_));
    for (const int v : moved_) vertex(scratch_.p, v).setZero();
    return answer;
  }
  int vertex_count() const { return static_cast<int>(mass_.size()); }  // of all its stencils

  int size() const override { return 3 * static_cast<int>(blocks_.size()); }
  void move_to(const VecX& q) override;
  double value() override { return inner_->value(); }
  double value_noise() const override { return inner_->value_noise(); }
  const VecX& gradient() override { return inner_->gradient(); }
  const BlockMatrix& hessian(const HessianRequest& request) override {
    return inner_->hessian(request);
  }
  int value_count() const override { return value_count_before_ + inner_->value_count(); }

 private:
  bool has_local_form() const;
  void build();
  void begin_inner();
  void read_start();
  void build_whole();
  void build_local();
  std::vector<std::unique_ptr<Term>> restricted_terms();
  void place(const VecX& q);
  void displace(const VecX& p);
  void find_contacts();

  StepPotential& whole_;
  World& world_;
  PhaseClock& clock_;
  StepPotential::Scratch& scratch_;
  std::vector<int> blocks_, owners_, moved_;
  bool resumed_;
  VecX start_, positions_at_start_;  // positions of the moved vertices [m]

  bool local_ = true;  // false: all terms are evaluated as a whole
  LocalVertices vertices_;
  std::vector<std::unique_ptr<Term>> parts_;
  std::unique_ptr<LocalContact> contact_;
  ContactSet contacts_;          // with local vertices
  long candidates_version_ = 0;  // for which contact_ was made
  VecX mass_;                    // of the local vertices [kg]
  DofMap dofs_;
  PhaseClock own_clock_;  // terms of parts are not timed, and phases are those of the caller
  std::unique_ptr<IncrementalPotential> inner_;
  int value_count_before_ = 0;
};

}  // namespace tack
