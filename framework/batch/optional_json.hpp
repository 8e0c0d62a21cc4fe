// Optional numbers as JSON: null where there is none.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>

namespace tack {

inline nlohmann::ordered_json optional_json(const std::optional<double>& number) {
  return number ? nlohmann::ordered_json(*number) : nlohmann::ordered_json();
}

inline std::optional<double> optional_number(const nlohmann::ordered_json& json) {
  return json.is_null() ? std::nullopt : std::optional<double>(json.get<double>());
}

}  // namespace tack
