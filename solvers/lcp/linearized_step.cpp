#include "solvers/lcp/linearized_step.hpp"

#include <algorithm>

#include "framework/core/damping_terms.hpp"
#include "framework/world/step_potential.hpp"

namespace tack {
namespace {

// Returns whether rows and impulses represent the term. Any other term, dynamic or not, acts
// linearised.
bool has_rows(const World& world, const Term* term) {
  const std::vector<Term*> contact = world.contact_terms();
  return std::find(contact.begin(), contact.end(), term) != contact.end();
}

}  // namespace

LinearizedStep::LinearizedStep(World& world, PhaseClock& clock, LinearSolver& solver) : world_(world), clock_(clock), solver_(solver) {
  for (const Term* term : world.terms)
    if (!has_rows(world, term)) terms_.push_back(term);
}

LinearizedStep::~LinearizedStep() = default;

void LinearizedStep::new_unknowns() {
  potential_.reset();
  of_all_.reset();
}

// Returns -K_s p_s in the unknowns, times the potential's scale h^2, inertia included.
VecX LinearizedStep::imposed(const Step& step) {
  if (!of_all_) {
    all_ = DofMap(std::vector<char>(world_.dofs.vertex_count(), 1), world_.dofs.dependences());
    of_all_ = std::make_unique<StepPotential>(world_, clock_, terms_, all_, world_.mass);
  }
  of_all_->begin_step(step.state.x, step.prediction.x, step.prediction.scales(), true);
  VecX q, displacement, force;
  all_.gather(step.state.x, q);
  of_all_->move_to(q);
  all_.gather(VecX(x_fixed_ - step.state.x), displacement);
  of_all_->hessian({Projection::clamp}).multiply(displacement, force);
  VecX in_unknowns(world_.dofs.size());
  for (int b = 0; b < world_.dofs.block_count(); ++b)
    in_unknowns.segment<3>(3 * b) = -force.segment<3>(3 * all_.block(world_.dofs.vertex_of_block(b)));
  take_held_out(in_unknowns);
  return in_unknowns;
}

bool LinearizedStep::begin(const Step& step) {
  h_ = step.h;
  x_fixed_ = step.targets;
  world_.dofs.update_dependents(x_fixed_);
  if (!potential_) potential_ = std::make_unique<StepPotential>(world_, clock_, terms_, world_.dofs, world_.mass);
  potential_->begin_step(step.state.x, step.prediction.x, step.prediction.scales(), true);
  VecX q;
  world_.dofs.gather(step.state.x, q);
  potential_->move_to(q);
  const VecX pushed = step.has_prescribed_motion() ? imposed(step) : VecX::Zero(world_.dofs.size());
  const BlockMatrix& matrix = potential_->hessian({Projection::clamp});
  const VecX rhs = pushed - potential_->gradient();
  free_ = VecX::Zero(rhs.size());
  if (rhs.size() == 0) return true;
  if (!rhs.allFinite() || !solver_.factorize(matrix, clock_)) return false;
  solver_.solve(rhs, free_, clock_);
  return free_.allFinite();
}

VecX LinearizedStep::end(const VecX& p) const {
  VecX q, x = x_fixed_;
  world_.dofs.gather(x_fixed_, q);
  world_.dofs.scatter(q + free_ + p, x);
  return x;
}

void LinearizedStep::solve(Eigen::MatrixXd& rhs) {
  clock_.deadline().check();
  solver_.solve_columns(rhs, clock_);
}

void LinearizedStep::take_held_out(Eigen::Ref<VecX> column) const {
  for (const DofMap::PartlyFixedBlock& h : world_.dofs.partly_fixed_blocks())
    column.segment<3>(3 * h.block) -= (h.projection * column.segment<3>(3 * h.block)).eval();
}

}  // namespace tack
