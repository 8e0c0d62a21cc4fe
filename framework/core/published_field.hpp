// Declaration of a field that terms publish (FieldRecord). Registered beside the term, so that a
// scene can name it in output.fields before the world is built:
//   TACK_REGISTER(PublishedField, BondIntensity, "bond_intensity", "Of bonds: 1 where all are
//   whole.", "");
#pragma once

#include "framework/config/registry.hpp"

namespace tack {

class PublishedField : public Component {
 public:
  static constexpr const char* kind_name = "field";
  static constexpr const char* kind_doc =
      "What output.fields can name of what acts in a scene, besides what it lists itself.";

  virtual const char* unit() const { return ""; }
  virtual bool of_elements() const { return false; }  // false: a field on vertices
  // Components per element: 1, 3, or 6 of a symmetric tensor (xx, yy, zz, xy, yz, xz).
  virtual int components() const { return 1; }
};

}  // namespace tack
