// A component with other keys laid over its own.
#pragma once

#include "framework/config/bind.hpp"
#include "framework/config/merge.hpp"

namespace tack {

/// Returns the keys of a component with `over` merged into them. A `type` in `over` other than that
/// of the component replaces it. over: null, a name or a map.
template <class Base>
Value merged_component(const Base* component, const Value& over) {
  Value value = to_value(component);
  if (!over.is_null()) merge(value, over);
  if (!value.is_scalar()) return value;
  const Value type = value;  // only a name
  value = Value::map();
  value.set("type", type);
  return value;
}

}  // namespace tack
