// Contact model `ogc`: Offset Geometric Contact. Each vertex presses on the blocks of faces, edges and
// vertices in which it lies, along the normals of the surface (ogc_search.hpp). Steps are limited by
// continuous collision detection, as for all models.
#include <optional>

#include "framework/contact/contact_model.hpp"
#include "framework/contact/contact_potential.hpp"
#include "framework/contact/contact_system.hpp"
#include "framework/contact/ogc/ogc_search.hpp"

namespace tack {
namespace {

class OffsetContact : public ContactPotential {
 public:
  std::string refusal(ContactFeature feature, const PairSetup& pair) const override {
    switch (feature) {
      case ContactFeature::adhesion:
      case ContactFeature::tangential_adhesion: return "its forces jump where blocks of concave surfaces overlap, which adhesion would multiply";
      case ContactFeature::rods:
      case ContactFeature::particles: return "its offset blocks are those of faces and of their edges and vertices";
      default: return ContactPotential::refusal(feature, pair);
    }
  }
  bool uses_rest_gaps() const override { return true; }
  std::unique_ptr<ContactPotential> isolated(int, int) const override { return std::make_unique<OffsetContact>(); }

  void set_free(std::vector<char> free) override { free_ = std::move(free); }
  void find(const VecX& x, ContactSet& contacts) override {
    find_ogc_contacts({system().surface(), *rings_, system().pairs(), free_}, system().candidates(), x, contacts);
  }

 protected:
  void make_terms() override {
    rings_.emplace(system().surface());
    ContactPotential::make_terms();
  }

 private:
  std::vector<char> free_;
  std::optional<SurfaceRings> rings_;
};

class OgcModel : public ContactModel {
 public:
  std::unique_ptr<ContactPotential> make_potential() const override { return std::make_unique<OffsetContact>(); }
};

TACK_REGISTER(ContactModel, OgcModel, "ogc",
              "Offset Geometric Contact: a vertex presses on the face, edge or vertex in whose offset block it lies, along the normals of the surface. "
              "Without adhesion, rods and particles.",
              "Chen, Hsu, Liu, Macklin, Yang, Yuksel 2025, Offset Geometric Contact, ACM TOG 44(4)");

}  // namespace
}  // namespace tack
