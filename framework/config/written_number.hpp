// A number with the unit behind it, as in a scene's text: "100000 kg m^-1 s^-2" of a parameter,
// "2e5" of a key whose unit is known.
#pragma once

#include <optional>
#include <string>

namespace tack {

struct WrittenNumber {
  double si = 0;
  std::string unit;  // SI, of the same dimension; "" of a plain number

  // Another number of the same unit, as a file would have it.
  std::string text_of(double other) const;
};

// Nothing for a text that is no number with a known unit.
std::optional<WrittenNumber> written_number(const std::string& text);

}  // namespace tack
