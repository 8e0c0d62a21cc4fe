// Contact model `area_integral`: laws are energies per area, integrated over the overlap of two
// surfaces. Quadrature points are vertices and interior points of partly overlapping triangles, and
// see the other surface through inclusion-exclusion (narrow_phase.hpp); forces of overlap
// boundaries are a term of their own (overlap_boundary_term.hpp). Theory:
// docs/theory/contact_integral.md.
//
// History variables: the integration sides of pairs that adhere, and lagged weights of rods and
// particles.
#pragma once

#include <memory>
#include <optional>

#include "framework/contact/area_integral/narrow_phase.hpp"
#include "framework/contact/contact_model.hpp"
#include "framework/contact/contact_potential.hpp"

namespace tack {

class AreaIntegral : public ContactPotential {
 public:
  std::string refusal(ContactFeature feature, const PairSetup& pair) const override;
  double safety_barrier_range(double chosen) const override { return chosen; }
  bool uses_rest_gaps() const override { return true; }
  PairLawIds add_laws(const PairSetup& pair, const PreparedLaws& laws, PairTable& table) override;
  PairRoles roles(const PairSetup& pair, const PairTable& table) override;
  std::unique_ptr<ContactPotential> isolated(int a, int b) const override;

  void clear_caches() override;
  void set_free(std::vector<char> free) override { narrow_phase_->set_free(std::move(free)); }
  void load_history(const History& history) override;
  void commit(const VecX& x, History& history) const override;
  void begin_step(const VecX& x, bool new_candidates) override;
  void set_candidates(const VecX& x) override;
  void find(const VecX& x, ContactSet& contacts) override;
  std::unique_ptr<LocalContact> local(std::span<const int> moved) override;

  std::vector<OverlapSite> overlap_sites(const PairFilter& wanted) const override;
  void keep_sides(IntegrationSides::Pairs pairs) override { kept_sides_ = std::move(pairs); }

  // Returns the overlaps of the surfaces and the overlap-boundary forces in the present step.
  const SurfaceOverlap& overlap() const { return narrow_phase_->overlap(); }
  const OverlapBoundaryForces& overlap_boundary_forces() const {
    return narrow_phase_->overlap_boundary_forces();
  }
  const CollisionMesh& mesh() const;
  const IntegrationRules& rules() const { return *rules_; }

 protected:
  void make_terms() override;
  // Takes rules and history of the objects a and b of another potential, which are 0 and 1 here.
  void take_history(const AreaIntegral& other, int a, int b);

 private:
  IntegrationRules& rules_of(const PairTable& table);

  std::optional<IntegrationRules> rules_;  // none: no pair has been built
  std::unique_ptr<NarrowPhase> narrow_phase_;
  // Pairs whose coarser side was the secondary side in the last accepted step; none: unknown.
  std::optional<IntegrationSides::Pairs> previous_coarse_pairs_;
  IntegrationSides::Pairs kept_sides_;
};

}  // namespace tack
