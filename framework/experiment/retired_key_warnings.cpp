#include "framework/experiment/retired_key_warnings.hpp"

#include "framework/config/retired_keys.hpp"

namespace tack {

std::vector<Warning> retired_key_warnings(const Value& root, const Experiment& experiment) {
  std::vector<Warning> warnings;
  for (std::string& text : retired_key_texts(root, fields_of(experiment)))
    warnings.emplace_back(WarningKind::retired_key, std::move(text));
  return warnings;
}

}  // namespace tack
