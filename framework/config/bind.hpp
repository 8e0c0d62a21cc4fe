// Binds a parsed value to an object with fields(). Unknown keys are errors. All errors of one pass
// form one InputError, one per line: `file.yaml:12:5: unknown key 'yong' in energy 'neo_hookean';
// did you mean 'young'? (keys: ...)`. Absent keys leave members as they are. Parameters of the
// value may replace numbers (parameters.hpp).
#pragma once

#include <memory>
#include <string_view>

#include "framework/config/field.hpp"
#include "framework/config/reader.hpp"

namespace tack {

template <class T>
void bind(const Value& value, T& object, std::string_view context) {
  Fields fields = fields_of(object);
  Reader reader(Parameters::of(value));
  reader.bind(value, fields, context);
  reader.finish();
}

// Makes a component from its name or from a map with `type`.
template <class Base>
std::unique_ptr<Base> bind_component(const Value& value) {
  Reader reader;
  const Kind& kind = Registry<Base>::kind();
  auto made = reader.component(value, kind, nullptr, kind.name());
  reader.finish();
  return Registry<Base>::downcast(std::move(made));
}

// Makes a component with the parameters of `specified`. State that `specified` has computed is not
// copied.
template <class Base>
std::unique_ptr<Base> instance_of(const Base& specified) {
  return bind_component<Base>(to_value(&specified));
}

}  // namespace tack
