// Friction and tangential adhesion of a time step (the paper, sections 3.1 and 4.3):
//     P_t(x) = sum_k mu lambda_k f0(|u_k|) + mu_a lambda_a,k f_t0(|u_k|),    u_k = T_k^T (x - x^n)
// with the slip laws of tangential_law.hpp, over contact points (contact_points.hpp) whose
// magnitudes, closest points and tangents are held: those of the start of the step, or of the
// latest solution when the step is solved again. The slip always counts from the start of the step,
// and eps h follows h. Rods and particles that roll turn by it: their contact points move by
// numbers as well (rolling_points.hpp), and have batches of their own behind the others.
//
// The Hessian of a point is c c^T (x) T H T^T (slip.hpp): its only nonzero eigenvalues are |c|^2
// times those of H, so projecting is in closed form.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <set>

#include "framework/contact/contact_points.hpp"
#include "framework/contact/contact_term.hpp"
#include "framework/contact/rolling_points.hpp"
#include "framework/contact/tangential_law.hpp"
#include "framework/core/residual_view.hpp"

namespace tack {

class FrictionTerm : public Term, public ResidualView {
 public:
  // system, normal: must outlive the term. spins: of what turns by friction.
  FrictionTerm(const ContactSystem& system, const ContactTerm& normal,
               ContactSpins spins = ContactSpins());

  void clear_caches() override { take({}); }
  void begin_step(const StepStart& start) override;
  // Takes magnitudes and tangents at x, where the contact system must be. A step of zero length has
  // no points, as nothing slides in it.
  bool lags() const override { return true; }
  void lag(const VecX& x) override { take(h_ > 0 ? lagged_at(x) : ContactPoints()); }
  // Returns the contact points that lag(x) would take.
  ContactPoints lagged_at(const VecX& x) const;
  // Holds `now` between these objects, and nothing else anew.
  using Objects = std::array<int, 2>;  // two, ascending
  void hold(const ContactPoints& now, const std::set<Objects>& between);
  // Returns the residual of the lagged forces: the largest change of a vertex's force at x if `now`
  // were taken, over the largest force.
  double residual(const VecX& x, const ContactPoints& now) const;
  double residual(const VecX& x) const { return residual(x, lagged_at(x)); }
  // The sums of the normal forces of each two objects that rub [N].
  using PairForces = std::map<Objects, double>;
  PairForces normal_forces(const ContactPoints& points) const;
  PairForces normal_forces() const { return normal_forces(points_); }
  // Multiplies those that are held by a factor for each two objects, one where none is given.
  void scale_normal_forces(const PairForces& factors);

  double value(const VecX& x) const override { return term_value(x, TangentialPart::all); }
  std::vector<StencilBatch> batches() const override;
  bool dynamic() const override { return true; }
  void derivatives(const VecX& x, Projection projection, double* gradient,
                   double* hessian) const override;

  // Least squares (friction_term_residuals.cpp).
  const ResidualView* residual_view() const override { return this; }
  std::vector<ResidualBatch> residual_batches() const override;
  bool residuals(const VecX& x, double* r, double* jacobian) const override;

  double term_value(const VecX& x, TangentialPart part) const;
  bool stores() const override { return false; }
  void publish(Records& records) const override;
  // Force times slip since the start of the step: what a part dissipates on the way to x [J].
  double dissipated(const VecX& x, TangentialPart part) const;
  // The same of both parts, by contact points.
  void visit_dissipation(const VecX& x, const EnergyVisitor& visit) const;
  // The force of a part on every vertex (3n) [N]; with a pair, of its points only.
  VecX forces(const VecX& x, TangentialPart part,
              std::optional<ObjectPair> only = std::nullopt) const;
  // The force that object b exerts on object a [N].
  Vec3 force_between(const VecX& x, TangentialPart part, ObjectPair pair) const;

  const ContactPoints& points() const { return points_; }

 private:
  // Sets the contact points on which friction acts from now on.
  void take(ContactPoints points);
  const ContactPoints& sliding() const { return spins_.empty() ? points_ : sliding_; }
  VecX forces_of(const ContactPoints& sliding, const std::vector<RollingGroup>& rolling,
                 const VecX& x, TangentialPart part, std::optional<ObjectPair> only) const;
  // The sum of number(slip, its law) over all points.
  template <class Number>
  double sum_of(const VecX& x, const Number& number) const;

  const ContactSystem& system_;
  const ContactTerm& normal_;
  std::vector<char> wanted_;  // per law of the pair table: it acts along surfaces
  VecX start_;                // x^n
  double h_ = 0;              // s
  ContactSpins spins_;
  ContactPoints points_;   // all of them
  // If something may turn: contact points at which nothing turns, and the others.
  ContactPoints sliding_;
  std::vector<RollingGroup> rolling_;
  mutable std::array<std::vector<int>, contact_arity_count> batch_vertices_;
};

}  // namespace tack
