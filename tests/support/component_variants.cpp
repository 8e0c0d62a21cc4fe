#include "tests/support/component_variants.hpp"

namespace tack::detail {

std::vector<std::string> settings_of(const Fields& fields) {
  std::vector<std::string> settings = {""};
  for (const Field& field : fields.all()) {
    std::vector<std::string> values;
    if (field.shape.form == Shape::Form::choice) {
      for (const auto& option : field.shape.options) values.push_back(option.name);
    } else if (field.mandatory) {
      values.push_back(field.write().text);
    }
    if (values.empty()) continue;
    std::vector<std::string> longer;
    for (const auto& start : settings)
      for (const auto& value : values) longer.push_back(start + ", " + field.key + ": " + value);
    settings = longer;
  }
  return settings;
}

bool applies(const std::map<std::string, std::string>& extra, const Fields& fields) {
  for (const auto& [key, value] : extra)
    if (!fields.find(key)) return false;
  return true;
}

}  // namespace tack::detail
