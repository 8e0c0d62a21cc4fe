// Contact model `gcp`: the Geometric Contact Potential. Pairs of primitives press where their closest
// points are near a local minimum of the distance on both surfaces, and outside both bodies.
#include <optional>

#include "framework/config/field.hpp"
#include "framework/contact/contact_model.hpp"
#include "framework/contact/contact_potential.hpp"
#include "framework/contact/contact_system.hpp"
#include "framework/contact/gcp/gcp_energy.hpp"
#include "framework/contact/gcp/gcp_points.hpp"

namespace tack {
namespace {

class GeometricPotential : public ContactPotential {
 public:
  explicit GeometricPotential(const GcpSmoothing& smoothing) : smoothing_(smoothing) {}

  std::string refusal(ContactFeature feature, const PairSetup& pair) const override {
    switch (feature) {
      case ContactFeature::adhesion:
      case ContactFeature::tangential_adhesion: return "its directional factors take forces away where surfaces are not about to touch";
      case ContactFeature::rods:
      case ContactFeature::particles: return "its factors need the triangles around an edge or a vertex";
      default: return ContactPotential::refusal(feature, pair);
    }
  }
  std::unique_ptr<ContactPotential> isolated(int, int) const override { return std::make_unique<GeometricPotential>(smoothing_); }

  void set_free(std::vector<char> free) override { contacts_->set_free(std::move(free)); }
  void find(const VecX& x, ContactSet& contacts) override {
    contacts = {};
    contacts_->find(system().candidates(), x);
  }
  int active_count() const override { return static_cast<int>(contacts_->stencils().stencils.size()); }
  void visit_active(const ActiveVisitor& visit) const override {
    const std::vector<int>& object = system().surface().mesh.vertex_object;
    GcpPositions positions;
    for (const GcpStencil& s : contacts_->stencils().stencils) {
      const auto v = contacts_->stencils().vertices_of(s);
      gcp_positions(system().configuration(), v, positions);
      visit({object[v[0]], object[v[gcp_first_count(s.kind)]], s.law, gcp_distance(s.kind, positions), v.first(gcp_core_count(s.kind))});
    }
  }
  ContactPoints points(const ContactPointsRequest& request) const override { return gcp_points(*contacts_, *term_, request.wanted, request.x); }

 protected:
  void make_terms() override {
    contacts_.emplace(system().surface(), system().pairs(), smoothing_);
    auto term = std::make_unique<GcpTerm>(*contacts_);
    term_ = term.get();
    add_term(std::move(term));
  }

 private:
  GcpSmoothing smoothing_;
  std::optional<GcpContacts> contacts_;
  const GcpTerm* term_ = nullptr;
};

class GcpModel : public ContactModel {
 public:
  void fields(Fields& f) override {
    f.number("tangent_smoothing", smoothing_.alpha_t, units::none,
             "alpha_t, of the local-minimum factors: sine of the angle by which an edge may lean towards the other primitive before "
             "the pair has no force")
        .positive().at_most(1);
    f.number("normal_smoothing", smoothing_.alpha_n, units::none,
             "alpha_n, of the exterior factors: sine of the angle by which the other primitive may lie behind all triangles before the "
             "pair has no force")
        .positive().at_most(1);
  }
  std::unique_ptr<ContactPotential> make_potential() const override { return std::make_unique<GeometricPotential>(smoothing_); }

 private:
  GcpSmoothing smoothing_;
};

TACK_REGISTER(ContactModel, GcpModel, "gcp",
              "Geometric Contact Potential: pairs of primitives press where their closest points are near a local minimum of the distance on both "
              "surfaces and outside both bodies. No force at rest within an object. Without adhesion, rods and particles.",
              "Huang, Paik, Ferguson, Panozzo, Zorin 2025, Geometric Contact Potential, ACM TOG 44(4)");

}  // namespace
}  // namespace tack
