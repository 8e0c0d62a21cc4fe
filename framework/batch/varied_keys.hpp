// The map `keys` of a variation: keys of the experiment and the values that each takes.
//
//   objects.cube.energies.0.young: [1e5, 1e6]          values
//   contact.friction.mu: {values: [0.1, 0.2], as: mu}  and a heading for tables
//   objects.cube.energies.0.young: {from: 1e5, to: 1 MPa, scale: log, as: young}  a range to sample
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "framework/config/value.hpp"

namespace tack {

struct VariedRange {
  double from = 0, to = 1;  // as written, in `unit`
  std::string unit;         // of both bounds; empty: none
  bool log = false, whole = false;
  SourceMark mark;

  // Returns the value at the fraction u of the range, u in [0, 1), to six digits.
  Value at(double u) const;
};

struct VariedKey {
  std::string key;
  std::string column;
  SourceMark mark;
  std::vector<Value> values;         // either values
  std::optional<VariedRange> range;  // or a range
};

// Reads the map. Throws InputError with the source location: no map, no values, or a form that
// is not allowed here.
std::vector<VariedKey> keys_with_values(const Value& keys);
std::vector<VariedKey> keys_with_ranges(const Value& keys);

// Formats a value for tables: "0.3", "5 MPa", "{type: lbfgs}".
std::string shown_text(const Value& value);

}  // namespace tack
