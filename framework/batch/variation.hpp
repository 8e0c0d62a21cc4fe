// What varies from case to case of a batch: each entry of `vary` is a list of variants, and the cases are all
// combinations of them, the last entry varying fastest.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "framework/config/field.hpp"
#include "framework/config/registry.hpp"

namespace tack {

// One choice: the keys that it sets, and what tables show of it.
struct Variant {
  struct Setting {
    std::string key;  // "objects.cube.energies.0.young"
    Value value;
  };
  struct Shown {
    std::string column;  // its heading
    std::string text;    // as written: "1 MPa"
    std::string key;     // whose value it is; empty: the name of several
  };
  std::vector<Setting> set;
  std::vector<Shown> shown;
};

// Of two choices that are made together.
Variant joined(const Variant& a, const Variant& b);

class Variation : public Component {
 public:
  static constexpr const char* kind_name = "variation";
  static constexpr const char* kind_doc = "Scene keys that vary in a batch, and their values.";

  // At least one. Throws InputError with its place in the file.
  virtual std::vector<Variant> variants() const = 0;
  // How many these are, before they are made: where a number says so, they may be too many.
  virtual double count() const { return static_cast<double>(variants().size()); }
};

}  // namespace tack
