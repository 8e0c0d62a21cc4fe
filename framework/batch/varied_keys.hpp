// The map `keys` of a variation: which key of the experiment takes which values.
//
//   objects.cube.energies.0.young: [1e5, 1e6]                                     values
//   contact.friction.mu: {values: [0.1, 0.2], as: mu}                             and a heading for tables
//   objects.cube.energies.0.young: {from: 1e5, to: 1 MPa, scale: log, as: young}  a range to take samples of
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "framework/config/value.hpp"

namespace tack {

struct VariedRange {
  double from = 0, to = 1;  // as written, in `unit`
  std::string unit;         // of both; empty: none
  bool log = false, whole = false;
  SourceMark mark;

  // For u in [0, 1), to six digits.
  Value at(double u) const;
};

struct VariedKey {
  std::string key;
  std::string column;
  SourceMark mark;
  std::vector<Value> values;         // either these
  std::optional<VariedRange> range;  // or this
};

// Throws InputError with the place of what is wrong: no map, no values, another form than wanted.
std::vector<VariedKey> keys_with_values(const Value& keys);
std::vector<VariedKey> keys_with_ranges(const Value& keys);

// "0.3", "5 MPa", "{type: lbfgs}".
std::string shown_text(const Value& value);

}  // namespace tack
