// A number with its unit, as a scene file has it: "100000 kg m^-1 s^-2" of a parameter, "2e5" of a
// key whose unit is known.
#pragma once

#include <optional>
#include <string>

namespace tack {

struct WrittenNumber {
  double si = 0;
  std::string unit;  // SI, of the same dimension; "" for a plain number

  // Returns the text of another number with the same unit.
  std::string text_of(double other) const;
};

// Returns nothing for a text that is no number with a known unit.
std::optional<WrittenNumber> written_number(const std::string& text);

}  // namespace tack
