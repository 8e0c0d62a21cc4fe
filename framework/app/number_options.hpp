// Validators of numeric options.
#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <optional>
#include <string>

namespace tack {

// Returns the whole number that the text consists of; none: it is something else.
inline std::optional<int> whole_number(const std::string& text) {
  int number = 0;
  const auto [stop, status] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (status != std::errc() || stop != text.data() + text.size()) return std::nullopt;
  return number;
}

// Accepts counts. CLI11's own validator prints the whole range of doubles, digit by digit.
inline const CLI::Validator whole_number_above_zero(
    [](std::string& text) {
      return whole_number(text).value_or(0) > 0
                 ? std::string()
                 : fmt::format("expects a whole number above zero, got '{}'", text);
    },
    "POSITIVE");

// Largest number of cores for which the speed-up is predicted.
inline constexpr int cores_max = 4096;
inline const CLI::Validator core_count(
    [](std::string& text) {
      const int number = whole_number(text).value_or(0);
      return number > 1 && number <= cores_max
                 ? std::string()
                 : fmt::format("expects a whole number of 2 to {}, got '{}'", cores_max, text);
    },
    "CORES");

inline const CLI::Validator number_above_zero(
    [](std::string& text) {
      double number = 0;
      const auto [stop, status] = std::from_chars(text.data(), text.data() + text.size(), number);
      const bool good =
          status == std::errc() && stop == text.data() + text.size() && number > 0 && number < 1e6;
      return good ? std::string() : fmt::format("expects a number above zero, got '{}'", text);
    },
    "POSITIVE");

}  // namespace tack
