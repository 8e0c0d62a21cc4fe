// Decimal number at the beginning of a text, in any locale: digits with a point and an exponent.
#pragma once

#include <charconv>
#include <cstddef>
#include <limits>
#include <string_view>

namespace tack {

struct NumberText {
  double value = 0;        // infinite on overflow, 0 on underflow
  std::size_t length = 0;  // characters; 0: no number
};

inline NumberText number_text(std::string_view text) {
  NumberText number;
  const auto [stop, status] = std::from_chars(text.data(), text.data() + text.size(), number.value);
  number.length = static_cast<std::size_t>(stop - text.data());
  if (status != std::errc::result_out_of_range) return number;
  const std::string_view digits = text.substr(0, number.length);
  const bool small = digits.find("e-") != digits.npos || digits.find("E-") != digits.npos ||
                     digits.starts_with("0.") || digits.starts_with('.');
  number.value = small ? 0 : std::numeric_limits<double>::infinity();
  return number;
}

}  // namespace tack
