// Fields that terms publish (FieldRecord) and that frames can hold. They are registered beside
// their terms, so that scenes can name them in output.fields before there is a world:
//   TACK_REGISTER(PublishedField, BondIntensity, "bond_intensity", "Mean intensity.", "");
#pragma once

#include "framework/config/registry.hpp"

namespace tack {

/// Registered name, unit and shape of a field.
class PublishedField : public Component {
 public:
  static constexpr const char* kind_name = "field";
  static constexpr const char* kind_doc =
      "A field of bonds, energies or plugins that output.fields can name, in addition to those "
      "listed there.";

  virtual const char* unit() const { return ""; }
  virtual bool of_elements() const { return false; }  // else of vertices
  /// Components of a field of elements: 1, 3, or 6 of a symmetric tensor (xx, yy, zz, xy, yz, xz).
  virtual int components() const { return 1; }
};

}  // namespace tack
