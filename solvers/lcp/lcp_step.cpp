#include "solvers/lcp/lcp_step.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "framework/bond/bond_term.hpp"
#include "framework/contact/points/contact_points.hpp"
#include "framework/world/world.hpp"
#include "solvers/lcp/bond_rows.hpp"

namespace tack {
namespace {

// Limit of the searches per step for contacts that other impulses have closed.
constexpr int rounds = 8;

// Returns a frame whose columns are the normal and two tangents.
Mat3 frame_of(const Vec3& normal) {
  Mat3 frame;
  frame << normal, tangents_of(normal);
  return frame;
}

}  // namespace

LcpStep::LcpStep(World& world, PhaseClock& clock, LinearSolver& solver, const LcpSettings& settings)
    : world_(world), clock_(clock), settings_(settings), linear_(world, clock, solver) {
  if (!world.contact) return;
  finder_.emplace(*world.contact, settings.margin);
  impacts_.emplace(*world.contact, settings.margin);
}

double LcpStep::gap_excess(const ContactRow& contact) const {
  const double gap_excess = contact.distance - contact.gap;
  return gap_excess < 0 ? settings_.recovery * gap_excess : gap_excess;
}

void LcpStep::add_contact(int contact, const VecX& displacement) {
  const ContactRow& c = contacts_.rows[contact];
  const Mat3 frame = frame_of(c.normal);
  RowUnit unit;
  unit.first = rows_.count();
  unit.rows = c.mu > 0 ? 3 : 1;
  unit.contact = contact;
  unit.mu = c.mu;
  unit.start[0] = gap_excess(c);
  unit.free = frame.transpose() * c.moved(displacement) / linear_.h();
  Vec3 impulse = linear_.h() * frame.transpose() * c.force;
  impulse[0] = std::max(impulse[0], 0.0);
  if (const double size = impulse.tail<2>().norm(); size > c.mu * impulse[0]) impulse.tail<2>() *= c.mu * impulse[0] / size;
  for (int i = 0; i < unit.rows; ++i) {
    for (int k = 0; k < 4; ++k)
      if (c.coefficients[k] != 0) rows_.add(linear_.dofs(), c.vertices[k], c.coefficients[k] * frame.col(i));
    rows_.finish();
  }
  taken_[contact] = 1;
  sweeps_->add(unit, impulse);
}

void LcpStep::add_bonds(const VecX& x, const VecX& end) {
  if (!world_.bonds) return;
  for (int i = 0; i < world_.bonds->list().size(); ++i) add_bond_rows(*world_.bonds, i, x, end, linear_, rows_, *sweeps_);
}

// Adds contacts that close further than allowed, first those with a force in the last step. Returns
// their number.
int LcpStep::add_violated(const VecX& displacement, double tolerated, bool first) {
  int added = 0;
  for (size_t i = 0; i < contacts_.rows.size(); ++i) {
    const ContactRow& c = contacts_.rows[i];
    if (taken_[i]) continue;
    if (!(gap_excess(c) + c.normal.dot(c.moved(displacement)) < -tolerated) && !(first && !c.force.isZero(0))) continue;
    add_contact(static_cast<int>(i), free_);
    ++added;
  }
  return added;
}

// Adds contacts that are first met during the step. Returns their number.
int LcpStep::add_impacts(const VecX& x, const VecX& end) {
  if (!impacts_) return 0;
  const PhaseScope scope(clock_, Phase::ccd);
  const int before = static_cast<int>(contacts_.rows.size());
  impacts_->find(x, end, contacts_);
  const int after = static_cast<int>(contacts_.rows.size());
  taken_.resize(after, 0);
  for (int i = before; i < after; ++i) add_contact(i, free_);
  return after - before;
}

VecX LcpStep::end() const {
  return linear_.end(rows_.count() > 0 ? VecX(linear_.h() * sweeps_->made()) : VecX::Zero(linear_.dofs().size()));
}

void LcpStep::take_forces() {
  slid_ = 0;
  for (ContactRow& c : contacts_.rows) c.force.setZero();
  for (const RowUnit& unit : sweeps_->units())
    if (unit.contact >= 0) {
      ContactRow& c = contacts_.rows[unit.contact];
      c.force = frame_of(c.normal) * sweeps_->impulse(unit) / linear_.h();
      slid_ -= sweeps_->impulse(unit).tail<2>().dot(sweeps_->velocity(unit).tail<2>());
    }
  for (StoredPoint& p : contacts_.stored.points) p.force.setZero();
  for (StoredEdges& e : contacts_.stored.edges) e.force.setZero();
  for (const ContactRow& c : contacts_.rows)
    if (c.stored >= 0) (c.own == 1 ? contacts_.stored.points[c.stored].force : contacts_.stored.edges[c.stored].force) = c.force;
}

// Updates the history of contacts from the end of the step.
void LcpStep::look_back(const VecX& x, const VecX& end) {
  if (!finder_) return;
  const PhaseScope scope(clock_, Phase::narrow_phase);
  if (!met_) impacts_->find(x, end, contacts_);
  contacts_.stored.sort();
  ContactRows now = finder_->find(end, end - x, contacts_.stored);
  for (const ContactRow& row : now.rows) deepest_ = std::max(deepest_, -row.distance);
  stored_ = std::move(now.stored);
}

void LcpStep::solve(const Step& step, SolveResult& result) {
  contacts_ = {};
  stored_ = {};
  rows_ = {};
  residual_ = deepest_ = 0;
  met_ = false;
  sweeps_.emplace(linear_, rows_, settings_.dense_rows, [this](const RowUnit& unit, const Vec3& at) {
    return bond_stiffness(*world_.bonds, unit.bond, at, linear_.h());
  });
  if (!linear_.begin(step)) {
    result.minimizer.status = MinimizerStatus::factorization_failed;
    return;
  }
  const VecX& x = step.state.x;
  result.x = end();
  free_ = result.x - x;
  if (finder_) {
    const PhaseScope scope(clock_, Phase::narrow_phase);
    contacts_ = finder_->find(x, VecX(), StoredContacts::read(step.state.history, world_.contact->surface()));
    impacts_->begin(contacts_.stored);
  }
  taken_.assign(contacts_.rows.size(), 0);
  add_bonds(x, result.x);
  add_violated(free_, 0, true);
  bool converged = true;
  for (int round = 0; round < rounds; ++round) {
    if (rows_.count() > 0) {
      converged = sweeps_->solve(std::max(1, settings_.sweeps - sweeps_->sweeps()), settings_.tolerance, clock_);
      result.x = end();
    }
    if (round + 1 == rounds) break;
    int added = add_violated(result.x - x, settings_.tolerance * step.h, false);
    if (added == 0) added = add_impacts(x, result.x);
    if (added == 0) {
      met_ = true;  // no further contacts
      break;
    }
    converged = false;
  }
  if (rows_.count() > 0) residual_ = sweeps_->residual();
  result.minimizer.iterations = sweeps_->sweeps();
  result.minimizer.linear_solves = static_cast<int>(1 + sweeps_->solves());
  result.minimizer.residual = residual_ / settings_.tolerance;
  result.minimizer.status = !result.x.allFinite() ? MinimizerStatus::not_finite : converged ? MinimizerStatus::converged : MinimizerStatus::iteration_limit;
  if (!result.x.allFinite()) return;
  take_forces();
  look_back(x, result.x);
  world_.participants.move_to(result.x);
}

}  // namespace tack
