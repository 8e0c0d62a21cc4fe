#include "framework/contact/contact_potential.hpp"

#include <cmath>

#include "framework/contact/terms/contact_term.hpp"
#include "framework/contact/stencils/stencil_distance.hpp"

namespace tack {

ContactPotential::ContactPotential() = default;
ContactPotential::~ContactPotential() = default;

std::unique_ptr<LocalContact> ContactPotential::local(std::span<const int>) { return nullptr; }

PairLaw PreparedLaws::barrier_and_adhesion() const {
  PairLaw law(offset);
  law.add(barrier);
  if (adhesion) law.add(adhesion);
  return law;
}

std::string ContactPotential::refusal(ContactFeature feature, const PairSetup&) const {
  switch (feature) {
    case ContactFeature::bonds: return "it finds no overlap of surfaces, at whose points bonds form";
    case ContactFeature::regions:
    case ContactFeature::integration_side:
    case ContactFeature::both_sides: return "it counts close pairs, not areas";
    case ContactFeature::rods:
    case ContactFeature::particles: return "it sums over surfaces of triangles";
    default: return "";
  }
}

PairLawIds ContactPotential::add_laws(const PairSetup&, const PreparedLaws& laws, PairTable& table) {
  const int law = table.add_law(laws.barrier_and_adhesion(), laws.tangential);
  return {law, law, law};
}

PairRoles ContactPotential::roles(const PairSetup& pair, const PairTable& table) {
  const auto range = [&](int law) { return table.laws()[law].range(); };
  PairRoles roles;
  roles.first = roles.second = {pair.laws.pressure, 1, range(pair.laws.pressure), true};
  // The area of an edge pair is half the mean of its two edges' areas, which count the surface
  // twice.
  roles.edge = {pair.laws.safety_barrier, 0.25, range(pair.laws.safety_barrier)};
  roles.codimensional = {pair.laws.codimensional, 1, range(pair.laws.codimensional)};
  return roles;
}

void ContactPotential::attach(ContactSystem& system) {
  system_ = &system;
  clear_caches();
  make_terms();
}

ContactPoints ContactPotential::points(const ContactPointsRequest& request) const { return points_of_stencils(request); }

int ContactPotential::active_count() const { return static_cast<int>(system().contacts().size()); }

void ContactPotential::visit_active(const ActiveVisitor& visit) const {
  const std::vector<int>& object = system().surface().mesh.vertex_object;
  const VecX& x = system().configuration();
  for_each_kind(system().contacts(), [&](auto kind, const auto& stencils, const double*) {
    for (const auto& s : stencils)
      visit({object[s.vertices[0]], object[s.vertices[kind.first_vertices]], s.law, std::sqrt(stencil_distance<ValueKernels>(kind, x, s)), s.vertices});
  });
}

void ContactPotential::make_terms() { add_term(std::make_unique<ContactTerm>(system())); }

void ContactPotential::add_term(std::unique_ptr<Term> term) { terms_.push_back(std::move(term)); }

}  // namespace tack
