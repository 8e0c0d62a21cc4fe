// Binds a parsed value to an object with fields(): strict, and all errors of one pass in one
// InputError, each as `file.yaml:12:5: unknown key 'yong' in energy 'neo_hookean'; did you mean
// 'young'? (keys: ...)`. Keys that are absent leave the member as it is. Its `parameters`, if it has any, may stand in place of numbers (parameters.hpp).
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

// A component given by its name or by a map with `type`.
template <class Base>
std::unique_ptr<Base> bind_component(const Value& value) {
  Reader reader;
  const Kind& kind = Registry<Base>::kind();
  auto made = reader.component(value, kind, nullptr, kind.name());
  reader.finish();
  return Registry<Base>::downcast(std::move(made));
}

// A component with the parameters of one that is specified, and nothing else of it: what it works out and
// keeps is its own.
template <class Base>
std::unique_ptr<Base> instance_of(const Base& specified) {
  return bind_component<Base>(to_value(&specified));
}

}  // namespace tack
