// Adhesion law of two surfaces: a traction-separation law of the gap (NormalAdhesion,
// normal_law.hpp), or a law of bonds with history variables between sites on both surfaces
// (BondLaw, framework/bond/bond_law.hpp).
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
  double adhesion_peak = 0;  // peak traction of the pair's adhesion [Pa]; 0 without adhesion
  // The smaller stiffness of the two sides [Pa]; an affine body counts with a hundredth of its
  // own. 0 if neither side has one.
  double softer_stiffness = 0;
};

// Traits of an adhesion law, for lists of laws.
struct AdhesionTraits {
  bool reversible = true;                  // surfaces that separate adhere again as before
  bool history_dependent = false;          // its traction depends on history variables
  bool normal = true, tangential = false;  // directions in which it acts
};

class AdhesionLaw : public Component {
 public:
  static constexpr const char* kind_name = "adhesion";
  static constexpr const char* kind_doc =
      "Adhesion of two surfaces: a reversible traction-separation law of the gap, or cohesive "
      "bonds with history "
      "variables.";

  // Sets the parameters that were left to defaults. Called once, before use. Throws InputError for
  // a parameter that does not fit the pair.
  virtual void prepare(const PairMaterials& materials) = 0;
  virtual double peak_traction() const = 0;     // along the normal [Pa]
  virtual double work_of_adhesion() const = 0;  // of separation along the normal [J/m^2]
  virtual AdhesionTraits traits() const { return {}; }
  // Returns a remark on the prepared law, one line, or "".
  virtual std::string note() const { return ""; }
  // Returns warnings about the prepared law: why its results may be less accurate than expected.
  virtual std::vector<std::string> warnings() const { return {}; }
  std::string traits_text() const override {
    const AdhesionTraits t = traits();
    const char* mode = t.normal && t.tangential ? "mixed-mode (normal and tangential)"
                       : t.normal               ? "normal only"
                                                : "tangential only";
    return std::string(t.reversible ? "Reversible" : "Irreversible") +
           (t.history_dependent ? ", history-dependent, " : ", history-independent, ") + mode;
  }
};

}  // namespace tack
