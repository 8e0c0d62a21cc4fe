#include "tests/support/component_variants.hpp"

#include "framework/config/yaml_text.hpp"

namespace tack::detail {

std::vector<Setting> settings_of(const Fields& fields) {
  std::vector<Setting> settings = {{}};
  for (const Field& field : fields.all()) {
    std::vector<std::string> values;
    if (field.shape.form == Shape::Form::choice) {
      for (const auto& option : field.shape.options) values.push_back(option.name);
    } else if (field.mandatory && field.shape.form == Shape::Form::list) {
      values.push_back(inline_text(field.write()));
    } else if (field.mandatory) {
      values.push_back(field.write().text);
    }
    if (values.empty()) continue;
    std::vector<Setting> longer;
    for (const Setting& start : settings)
      for (const auto& value : values) longer.push_back(start), longer.back().emplace_back(field.key, value);
    settings = longer;
  }
  return settings;
}

std::string flow_map(const std::string& type, const Setting& setting, const std::map<std::string, std::string>& extra) {
  std::string yaml = "{type: " + type;
  for (const auto& [key, value] : setting)
    if (!extra.contains(key)) yaml += ", " + key + ": " + value;
  for (const auto& [key, value] : extra) yaml += ", " + key + ": " + value;
  return yaml + "}";
}

bool applies(const std::map<std::string, std::string>& extra, const Fields& fields) {
  for (const auto& [key, value] : extra)
    if (!fields.find(key)) return false;
  return true;
}

}  // namespace tack::detail
