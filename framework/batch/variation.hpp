// Variations between the cases of a batch. Each entry of `vary` is a list of variants, and the
// cases are all combinations of them, the last entry varying fastest.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "framework/config/field.hpp"
#include "framework/config/registry.hpp"

namespace tack {

// One variant: the keys that it sets, and the columns that tables show for it.
struct Variant {
  struct Setting {
    std::string key;  // "objects.cube.energies.0.young"
    Value value;
  };
  struct Shown {
    std::string column;  // its heading
    std::string text;    // as written: "1 MPa"
    std::string key;     // key of the value; empty: the name of several keys
  };
  std::vector<Setting> set;
  std::vector<Shown> shown;
};

// Joins the settings and columns of two variants.
Variant joined(const Variant& a, const Variant& b);

class Variation : public Component {
 public:
  static constexpr const char* kind_name = "variation";
  static constexpr const char* kind_doc = "Scene keys that vary in a batch, and their values.";

  // Returns the variants, at least one. Throws InputError with its source location.
  virtual std::vector<Variant> variants() const = 0;
  // Returns the number of variants without making them, since a count in the file may be too large
  // to make.
  virtual double count() const { return static_cast<double>(variants().size()); }
};

}  // namespace tack
