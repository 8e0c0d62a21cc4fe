// Adhesion of two surfaces, of either sort: a law of the gap between them (NormalAdhesion,
// normal_law.hpp), or one of bonds between places on them that remember (BondLaw,
// framework/bond/bond_law.hpp).
#pragma once

#include <string>
#include <vector>

#include "framework/config/registry.hpp"

namespace tack {

// Properties of a pair of objects that a law may depend on.
struct PairMaterials {
  double contact_distance = 0;  // dhat_b of the paper [m]
  // The smaller Young's modulus of the two sides [Pa]; 0 if neither has one.
  double softer_young = 0;
  double adhesion_peak = 0;     // peak traction of the pair's adhesion [Pa]; 0 without adhesion
  // As softer_young, an affine body having a hundredth of its stiffness [Pa]; 0: as that.
  double softer_stiffness = 0;
};

// Traits of an adhesion law, for lists of laws.
struct AdhesionTraits {
  bool reversible = true;   // what has come apart and comes back adheres as before
  bool remembers = false;   // its traction depends on what was
  bool normal = true, tangential = false;  // along which it acts
};

class AdhesionLaw : public Component {
 public:
  static constexpr const char* kind_name = "adhesion";
  static constexpr const char* kind_doc =
      "Adhesion of two surfaces: a reversible traction-separation law of the gap, or cohesive "
      "bonds with history "
      "variables.";

  // Called once, before use: fills what is left to defaults. Throws InputError for a parameter that
  // does not go with the pair.
  virtual void prepare(const PairMaterials& materials) = 0;
  virtual double peak_traction() const = 0;     // the largest along the normal [Pa]
  virtual double work_of_adhesion() const = 0;  // to part what adheres along the normal [J/m^2]
  virtual AdhesionTraits traits() const { return {}; }
  // note: a remark on the prepared law, one line, or "". doubts: reasons why the law is worth less
  // than it seems.
  virtual std::string note() const { return ""; }
  virtual std::vector<std::string> doubts() const { return {}; }
  std::string traits_text() const override {
    const AdhesionTraits t = traits();
    const char* mode = t.normal && t.tangential ? "mixed-mode (normal and tangential)"
                       : t.normal               ? "normal only"
                                                : "tangential only";
    return std::string(t.reversible ? "Reversible" : "Irreversible") +
           (t.remembers ? ", history-dependent, " : ", history-independent, ") + mode;
  }
};

}  // namespace tack
