// Builds tables from the entries of contact.pairs: contacting objects, their laws, the regions and
// the integration sides. Errors: InputError with the entry's source location.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "framework/bond/bond_table.hpp"
#include "framework/contact/clipped/clipped_laws.hpp"
#include "framework/contact/pair_table.hpp"
#include "framework/scene/pair_configs.hpp"
#include "framework/setup/loading.hpp"
#include "framework/setup/surface_regions.hpp"
#include "geometry/broad_phase/colliding_objects.hpp"

namespace tack {

class PairBuilder {
 public:
  // mean_areas: mean tributary area of a surface vertex, per object [m^2]. times: of the run.
  PairBuilder(const SceneConfig& scene, const Value& root, const std::vector<double>& mean_areas,
              const RunTimes& times, World& world);

  void build();

  PairTable& table() { return table_; }
  BondTable& bonds() { return bonds_; }
  ClippedLaws& clipped() { return clipped_; }
  const CollidingObjects& colliding() const { return colliding_; }

 private:
  struct LawIds {
    int pressure, safety_barrier;
    int summary = -1;        // of world.adhesion; -1: without adhesion
    int bond = -1;           // of the bond table; -1: without bonds
    int clipped = -1;        // of the clipped laws; -1: adhesion, if any, is part of `pressure`
    int codimensional = -1;  // of rods and particles
  };
  // Integration side of a pair.
  enum class Side { automatic, finer, both, first, second };
  // Settings of two objects that do not depend on the region.
  struct Integral {
    Side side = Side::automatic;
    bool adheres = false, overlap = false, bonds = false, gap_adhesion = false;
    double region_range = 0, clipped_range = 0;
  };
  struct Roles {
    // first, second: roles of the points of either object.
    PairRole first, second, edge, codimensional;
  };

  std::string contact_location() const;
  TangentialLaw tangential_of(const PairConfig* pair, double peak_traction) const;
  double offset_of(int a, int b) const;
  PairMaterials materials_of(int a, int b) const;
  double safety_barrier_range_of(int a, int b) const;
  LawIds laws_of(int a, int b, int config, int region);
  void add_to(AdhesionSummary& summary, int a, int b) const;
  void report(int a, int b, int region, const AdhesionLaw& adhesion, const PairLaw& law);
  void report(int a, int b, int region, const BondLaw& bond);
  bool has_surface(int object) const;
  bool clips(int a, int b, int config) const;
  void refuse_bond(int a, int b, int config) const;
  void check_regions(int a, int b, const std::vector<int>& regions, bool no_contact) const;
  BondRule rule_of(const PairConfig& pair, std::shared_ptr<const BondLaw> law,
                   const PairLaw& barrier, int config);
  Side integration_side_of(int a, int b, int config) const;
  void set_clipped(int a, int b, int config, const LawIds& ids, Side side);
  Side integration_side_of(int a, int b, int config, const std::vector<int>& regions) const;
  Roles roles_of(int a, int b, const LawIds& ids, const Integral& integral) const;
  void set_roles(int a, int b, int config, const std::vector<int>& regions);

  const SceneConfig& scene_;
  const ContactConfig& contact_;
  const Value& root_;
  World& world_;
  const std::vector<Loading> loadings_;  // of objects
  const std::vector<double> pressures_;  // dynamic ones, of objects [Pa]
  const std::vector<double> sheets_;     // stiffnesses of sheets, of objects [Pa]; 0: no sheet
  // Pressure of weight and loads per object [Pa]; 0 if the object does not adhere.
  const std::vector<double> resting_;
  ObjectClasses classes_;
  PairConfigs configs_;
  SurfaceRegions regions_;
  PairTable table_;
  CollidingObjects colliding_;
  BondTable bonds_;
  ClippedLaws clipped_;
  std::map<std::tuple<int, int, double, double, double, double, double>, LawIds> laws_;
};

}  // namespace tack
