// The normal contact potential P_N = sum_k w_k (b + a)(d_k) (the paper, section 4.1), over the
// active stencils of a ContactSystem. Laws are functions of the gap d. stencil_energy.hpp has the
// chain rule to squared distance, the weights and the edge-edge mollifier m,
//     E = w m phi(d),   s = d^2,   dphi/ds = phi'/(2 d),   d2phi/ds2 = (phi'' - phi'/d) / (4 s),
// and stencil_projection.hpp its Hessians projected to positive semi-definite matrices.
#pragma once

#include <optional>

#include "framework/contact/terms/contact_residuals.hpp"
#include "framework/contact/contact_system.hpp"
#include "framework/contact/stencils/stencil_kinds.hpp"
#include "framework/core/force_point.hpp"
#include "framework/core/records.hpp"
#include "framework/core/term.hpp"

namespace tack {

class ContactTerm : public Term, public ForcePoints {
 public:
  explicit ContactTerm(const ContactSystem& system);
  // Over stencils of the system's laws that others find, with vertices of any numbering. The set
  // must outlive the term. Its records and residuals are not available.
  ContactTerm(const ContactSystem& system, const ContactSet& contacts);

  double value(const VecX& x) const override;
  std::vector<StencilBatch> batches() const override;
  bool dynamic() const override { return true; }
  void derivatives(const VecX& x, Projection projection, double* gradient,
                   double* hessian) const override;
  const ResidualView* residual_view() const override { return &residuals_; }
  void mark_debonding(const VecX& from, const VecX& to, std::vector<char>& marks) const override;
  bool visit_energies(const VecX& x, const EnergyVisitor& visit) const override;
  void publish(Records& records) const override;

  double term_value(const VecX& x, LawTerm term) const;
  // Returns the force of a term of the laws on every vertex (3n) [N]; with a pair, of its stencils
  // only.
  VecX forces(const VecX& x, LawTerm term, std::optional<ObjectPair> only = std::nullopt) const;
  // Returns the normal force on each vertex in the first of its three entries (3n) [N]: the sum
  // over stencils of the forces along their normals, positive for pressure.
  VecX compressions(const VecX& x, LawTerm term) const;
  // Returns the force of object b on object a [N].
  Vec3 force_between(const VecX& x, LawTerm term, ObjectPair pair) const;
  // Visits the stencils in order. Their area is the weight, of pairs of edges with the mollifier,
  // whose slope turns the force of nearly parallel edges off the normal.
  void visit_points(const VecX& x, std::string_view summand,
                    const ForcePointVisitor& visit) const override;

 private:
  template <class Act>
  void for_each_gradient(const VecX& x, LawTerm term, const Act& act) const;

  const std::vector<PairLaw>& laws(LawTerm term) const { return system_.pairs().laws(term); }

  const ContactSystem& system_;
  const ContactSet& contacts_;
  ContactResiduals residuals_;
  mutable std::array<std::vector<int>, stencil_kind_count> batch_vertices_;
};

}  // namespace tack
