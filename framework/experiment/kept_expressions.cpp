#include "framework/experiment/kept_expressions.hpp"

#include "framework/config/describe.hpp"
#include "framework/config/parameters.hpp"

namespace tack {
namespace {

// Writes the expressions of `written` over the numbers at the same place of `resolved`.
void keep_expressions(Value& resolved, const Value& written, const Parameters& parameters) {
  if (written.is_scalar() && resolved.is_scalar()) {
    const bool path = resolved.text.starts_with('/');
    if (!path && parameters.named_in(written.text)) resolved.text = written.text;
  }
  if (resolved.items.size() == written.items.size())
    for (size_t i = 0; i < written.items.size(); ++i) keep_expressions(resolved.items[i], written.items[i], parameters);
  for (const Value::Entry& entry : written.entries)
    if (Value* value = resolved.find(entry.key)) keep_expressions(*value, entry.value, parameters);
}

}  // namespace

Value resolved_scene(const Value& root, const Experiment& experiment) {
  Value resolved = to_value(fields_of(experiment));
  if (!experiment.output.gradients.empty()) keep_expressions(resolved, root, Parameters::of(root));
  return resolved;
}

}  // namespace tack
