// An adhesion law as its pair of surfaces uses it: prepared, and with the barrier of the pair.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "framework/bond/bond_law.hpp"
#include "framework/contact/laws/pair_law.hpp"

namespace tack {

struct StudiedLaw {
  std::string name;  // "fang"; in a scene "fang of 'tape' - 'desk'"
  // Either a traction-separation law or a bond law.
  std::shared_ptr<const NormalAdhesion> gap;
  std::shared_ptr<const BondLaw> bond;
  PairLaw pair;  // law of the gap: barrier and adhesion; for bonds, the barrier alone
  double contact_distance = 0;  // m
  double young = 0;             // Young's modulus of the softer solid [Pa]; 0: unknown
  // The softer sheet or rod bends with this stiffness per width [N m]; 0: neither side is one.
  double bending_stiffness = 0;

  const AdhesionLaw& law() const { return gap ? static_cast<const AdhesionLaw&>(*gap) : *bond; }
};

struct StudySettings {
  std::optional<double> speed;  // opening speed of the surfaces [m/s]
  // Pressure that heals bonds [Pa]; the peak traction unless given.
  std::optional<double> pressure;
};

// A key number of a law.
struct KeyQuantity {
  std::string name;  // "peak traction"
  double value = 0;
  std::string unit;  // SI
  std::string remark = {};
};

}  // namespace tack
