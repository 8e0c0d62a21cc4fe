// Adhesion law as its pair of surfaces uses it: prepared, and with the barrier of the pair.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "framework/bond/bond_law.hpp"
#include "framework/contact/pair_law.hpp"

namespace tack {

struct StudiedLaw {
  std::string name;  // "fang"; of a scene "fang of 'tape' - 'desk'"
  std::shared_ptr<const NormalAdhesion> gap;  // one of both
  std::shared_ptr<const BondLaw> bond;
  PairLaw pair;  // what surfaces feel of their gap: barrier and adhesion, or beside bonds the
                 // barrier alone
  double contact_distance = 0;  // m
  double young = 0;             // of the softer side [Pa]; 0: not known

  const AdhesionLaw& law() const { return gap ? static_cast<const AdhesionLaw&>(*gap) : *bond; }
};

struct StudySettings {
  std::optional<double> speed;     // that surfaces part at [m/s]
  // Pressure on the surfaces [Pa]; the peak traction unless given
  std::optional<double> pressure;
};

// A key number of a law.
struct LawFigure {
  std::string name;  // of words; "peak traction"
  double value = 0;
  std::string unit;  // SI
  std::string remark = {};
};

}  // namespace tack
