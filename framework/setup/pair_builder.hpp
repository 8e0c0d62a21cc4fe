// Builds tables from the entries of contact.pairs: contacting objects, their laws, the regions and
// the integration sides. Errors: InputError with the entry's source location.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "framework/bond/bond_table.hpp"
#include "framework/contact/contact_potential.hpp"
#include "framework/contact/laws/pair_table.hpp"
#include "framework/scene/pair_configs.hpp"
#include "framework/setup/loading.hpp"
#include "framework/setup/surface_regions.hpp"
#include "geometry/broad_phase/colliding_objects.hpp"

namespace tack {

// Primitives by which an object takes part in contact.
struct ContactPrimitives {
  double mean_area = 0;  // tributary area of its surface vertices, mean [m^2]
  bool triangles = false, rods = false, particles = false;
};

class PairBuilder {
 public:
  // primitives: per object. times: of the run. potential: of the contact model, which chooses laws
  // and roles of each pair.
  PairBuilder(const SceneConfig& scene, const Value& root,
              std::vector<ContactPrimitives> primitives, const RunTimes& times, World& world,
              ContactPotential& potential);

  void build();

  PairTable& table() { return table_; }
  BondTable& bonds() { return bonds_; }
  const CollidingObjects& colliding() const { return colliding_; }

 private:
  struct LawIds {
    PairLawIds laws;
    int summary;  // of world.adhesion; -1: without adhesion
    int bond;     // of the bond table; -1: without bonds
  };

  std::string contact_location() const;
  std::string model_location() const;
  TangentialLaw tangential_of(const PairConfig* pair, double peak_traction, int a, int b) const;
  double offset_of(int a, int b) const;
  PairMaterials materials_of(int a, int b) const;
  double safety_barrier_range_of(int a, int b) const;
  LawIds laws_of(int a, int b, int config, int region);
  void add_to(AdhesionSummary& summary, int a, int b) const;
  void report(int a, int b, int region, const AdhesionLaw& adhesion, const PairLaw& law);
  void report(int a, int b, int region, const BondLaw& bond);
  PairSetup setup_of(int a, int b) const;
  void refuse_unsupported_barriers() const;
  void refuse_unsupported(const PairSetup& setup, int config, ContactFeature feature) const;
  void refuse_unsupported(const PairSetup& setup, int config, bool region) const;
  void refuse_unsupported_primitives(const PairSetup& setup) const;
  void refuse_bond(int a, int b, int config) const;
  void check_regions(int a, int b, const std::vector<int>& regions, bool no_contact) const;
  BondRule rule_of(const PairConfig& pair, std::shared_ptr<const BondLaw> law,
                   const PairLaw& barrier, int config);
  IntegrationSide integration_side_of(int a, int b, int config) const;
  IntegrationSide integration_side_of(int a, int b, int config,
                                      const std::vector<int>& regions) const;
  void set_roles(int a, int b, int config, const std::vector<int>& regions);

  const SceneConfig& scene_;
  const ContactConfig& contact_;
  const Value& root_;
  World& world_;
  ContactPotential& potential_;
  const std::vector<ContactPrimitives> primitives_;  // of objects
  const std::vector<Loading> loadings_;              // of objects
  const std::vector<double> pressures_;              // dynamic ones, of objects [Pa]
  const std::vector<double> sheets_;  // stiffnesses of sheets, of objects [Pa]; 0: no sheet
  // Pressure of weight and loads per object [Pa]; 0 if the object does not adhere.
  const std::vector<double> resting_;
  ObjectClasses classes_;
  PairConfigs configs_;
  SurfaceRegions regions_;
  PairTable table_;
  CollidingObjects colliding_;
  BondTable bonds_;
  std::map<std::tuple<int, int, double, double, double, double, double, double, int>, LawIds> laws_;
};

}  // namespace tack
