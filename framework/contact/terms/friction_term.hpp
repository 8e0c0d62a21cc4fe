// Friction and tangential adhesion of a time step (the paper, sections 3.1 and 4.3):
//     P_t(x) = sum_k mu lambda_k f0(|u_k|) + (mu_s - mu) lambda_k f_s0(|u_k|)
//            + mu_a lambda_a,k f_t0(|u_k|),    u_k = T_k^T (x - x^n)
// with the slip laws of tangential_law.hpp. Contact points k (contact_points.hpp) have lagged
// magnitudes, closest points and tangents: those of the start of the step, or of the latest
// solution when the step is solved again. The slip always counts from the start of the step, and
// eps h follows h. Friction that sticks adds the elastic slip of earlier steps, which is a history
// variable (stick_anchors.hpp). Rods and particles that roll turn by friction: their contact points
// depend on scalar dofs as well (rolling_points.hpp), and have batches of their own after the
// others.
//
// The Hessian of a point is c c^T (x) T H T^T (slip.hpp). Its only nonzero eigenvalues are |c|^2
// times those of H, so that its projection has a closed form.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <set>

#include "framework/contact/points/contact_points.hpp"
#include "framework/contact/contact_system.hpp"
#include "framework/contact/points/rolling_points.hpp"
#include "framework/contact/points/stick_anchors.hpp"
#include "framework/contact/tangential_law.hpp"
#include "framework/core/force_point.hpp"
#include "framework/core/records.hpp"
#include "framework/core/residual_view.hpp"
#include "framework/core/term.hpp"

namespace tack {

class FrictionTerm : public Term, public ResidualView, public ForcePoints {
 public:
  // system: must outlive the term. spins: rotations of rods and particles by friction.
  explicit FrictionTerm(const ContactSystem& system, ContactSpins spins = ContactSpins());

  // Sets the grain of each object's surface, a direction at rest; 0: none. Laws whose friction
  // differs across the grain need that of one of their objects.
  void set_grains(std::vector<Vec3> grains);

  void clear_caches() override { take({}); }
  void load_history(const History& history) override {
    if (sticks_) anchors_.read(history);
  }
  void begin_step(const StepStart& start) override;
  void commit(const VecX& x, History& history) const override;
  // Lags magnitudes and tangents at x. A step of zero length has no points, as nothing slides in
  // it. Throws logic_error if x is not the configuration of the contact system, as lagged_at().
  bool lags() const override { return true; }
  void lag(const VecX& x) override { take(h_ > 0 ? lagged_at(x) : ContactPoints()); }
  // Returns the contact points that lag(x) would set.
  ContactPoints lagged_at(const VecX& x) const;
  // Replaces the contact points between these objects by those of `now`, and keeps all others.
  using Objects = std::array<int, 2>;  // two, ascending
  void replace_points(const ContactPoints& now, const std::set<Objects>& between);
  // Returns the residual of the lagged forces: the largest change of the force on a vertex at x
  // from the lagged points to `now`, over the largest force.
  double residual(const VecX& x, const ContactPoints& now) const;
  double residual(const VecX& x) const { return residual(x, lagged_at(x)); }
  // Normal forces, summed per pair of objects with friction [N].
  using PairForces = std::map<Objects, double>;
  PairForces normal_forces(const ContactPoints& points) const;
  PairForces normal_forces() const { return normal_forces(points_); }
  // Multiplies the lagged normal forces by a factor per pair of objects; pairs that are missing
  // keep theirs.
  void scale_normal_forces(const PairForces& factors);

  double value(const VecX& x) const override { return term_value(x, TangentialTerm::all); }
  std::vector<StencilBatch> batches() const override;
  bool dynamic() const override { return true; }
  bool lagged_stencils() const override { return true; }
  void derivatives(const VecX& x, Projection projection, double* gradient,
                   double* hessian) const override;

  // Least squares (friction_term_residuals.cpp).
  const ResidualView* residual_view() const override { return this; }
  std::vector<ResidualBatch> residual_batches() const override;
  bool residuals(const VecX& x, double* r, double* jacobian) const override;

  std::unique_ptr<Term> restricted(const StencilChoice& choice) const override;

  double term_value(const VecX& x, TangentialTerm term) const;
  bool stores() const override { return false; }
  void publish(Records& records) const override;
  // Returns the energy that a term dissipates in the step to x: force times slip [J]. Springs of
  // sticking contacts count: what they take up is dissipated, what they give back is negative.
  double dissipated(const VecX& x, TangentialTerm term) const;
  // Visits the energies that both terms dissipate, by contact points.
  void visit_dissipation(const VecX& x, const EnergyVisitor& visit) const;
  // Returns the force of a term on every vertex (3n) [N]; with a pair, of its points only.
  VecX forces(const VecX& x, TangentialTerm term,
              std::optional<ObjectPair> only = std::nullopt) const;
  // Returns the force of object b on object a [N].
  Vec3 force_between(const VecX& x, TangentialTerm term, ObjectPair pair) const;

  // Visits the contact points of the step: their lagged geometry and normal forces, and the force
  // at x.
  void visit_points(const VecX& x, std::string_view summand,
                    const ForcePointVisitor& visit) const override;

  const ContactPoints& points() const { return points_; }

 private:
  // Sets the contact points on which friction acts from now on.
  void take(ContactPoints points);
  const ContactPoints& sliding() const { return spins_.empty() ? points_ : sliding_; }
  VecX forces_of(const ContactPoints& sliding, const std::vector<RollingGroup>& rolling,
                 const VecX& x, TangentialTerm term, std::optional<ObjectPair> only) const;
  // Returns the sum of number(slip, law) over all points.
  template <class Number>
  double sum_of(const VecX& x, const Number& number) const;

  const ContactSystem& system_;
  bool sticks_;  // some law of the pair table does
  StickAnchors anchors_;
  std::vector<Vec3> grains_;  // per object
  bool grained_ = false;      // some law differs across the grain
  std::vector<char> wanted_;  // per law of the pair table: whether it has a tangential law
  VecX start_;                // x^n (3n) [m]
  double h_ = 0;              // step length [s]
  ContactSpins spins_;
  ContactPoints points_;  // all contact points
  // With spins: contact points without rotations, and those with rotations.
  ContactPoints sliding_;
  std::vector<RollingGroup> rolling_;
  mutable std::array<std::vector<int>, contact_arity_count> batch_vertices_;
};

}  // namespace tack
