// The Geometric Contact Potential as a term: the sum of the energies of all stencils
// (gcp_stencil.hpp) at the present configuration. Source: Huang et al. 2025, ACM TOG 44(4).
#pragma once

#include <optional>

#include "framework/contact/gcp/gcp_search.hpp"
#include "framework/core/force_point.hpp"
#include "framework/core/records.hpp"
#include "framework/core/term.hpp"

namespace tack {

// Stencils of the present configuration.
class GcpContacts {
 public:
  // The surface and the pairs must outlive this. Throws InputError for vertices with more than
  // gcp_valence_max neighbours.
  GcpContacts(const ContactSurface& surface, const PairTable& pairs, const GcpSmoothing& smoothing);

  // Sets the free vertices (non-zero): no stencil is without one. Empty: all are free.
  void set_free(std::vector<char> free) { free_ = std::move(free); }
  // Finds the stencils at x (3n) [m].
  void find(const Candidates& candidates, const VecX& x);

  const GcpStencils& stencils() const { return stencils_; }
  const ContactSurface& surface() const { return surface_; }
  const SurfaceRings& rings() const { return rings_; }
  const PairTable& pairs() const { return pairs_; }
  const GcpSmoothing& smoothing() const { return smoothing_; }
  const GcpRestRanges& rest_ranges() const { return rest_; }

 private:
  const ContactSurface& surface_;
  const PairTable& pairs_;
  GcpSmoothing smoothing_;
  SurfaceRings rings_;
  GcpRestRanges rest_;
  std::vector<char> free_;
  GcpStencils stencils_;
};

class GcpTerm : public Term, public ForcePoints {
 public:
  explicit GcpTerm(const GcpContacts& contacts);

  double value(const VecX& x) const override;
  std::vector<StencilBatch> batches() const override;
  bool dynamic() const override { return true; }
  void derivatives(const VecX& x, Projection projection, double* gradient,
                   double* hessian) const override;
  bool visit_energies(const VecX& x, const EnergyVisitor& visit) const override;
  void publish(Records& records) const override;

  // Returns the force on every vertex (3n) [N]; with a pair, of stencils between these objects
  // only.
  VecX forces(const VecX& x, std::optional<ObjectPair> only = std::nullopt) const;
  // Returns the force of object b on object a [N].
  Vec3 force_between(const VecX& x, ObjectPair pair) const;
  // Visits the stencils. In self-contact their forces are without those of the directional factors,
  // whose vertices belong to both sides.
  void visit_points(const VecX& x, std::string_view summand,
                    const ForcePointVisitor& visit) const override;
  // Returns -w Gamma phi' of each stencil [N]: the force along the shortest vector, without that
  // of the directional factors.
  std::vector<double> normal_forces(const VecX& x) const;

 private:
  template <class Body>
  void for_each_sample(const VecX& x, const Body& body) const;

  const GcpContacts& contacts_;
};

}  // namespace tack
