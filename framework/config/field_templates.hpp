// Member templates of Fields, which depend on the member's type. Only field.hpp includes this file.
#pragma once

#include <stdexcept>

#include "framework/config/field.hpp"
#include "framework/config/reader.hpp"

namespace tack {

template <class E>
Field& Fields::choice(std::string key, E& target,
                      std::type_identity_t<std::vector<Choice<E>>> options, std::string doc) {
  std::vector<Shape::Option> described;
  std::vector<E> values;
  for (Choice<E>& o : options) {
    described.push_back({std::move(o.name), std::move(o.doc)});
    values.push_back(o.value);
  }
  const auto get = [values, &target]() -> std::size_t {
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (values[i] == target) return i;
    }
    throw std::logic_error("a choice holds a value that is not among its options");
  };
  const auto set = [values, &target](std::size_t i) { target = values[i]; };
  return choice_by_index(std::move(key), std::move(doc), std::move(described), set, get);
}

template <class T>
Shape object_shape() {
  Shape s = simple_shape(Shape::Form::object);
  s.prototype = prototype<T>;
  return s;
}

template <class T>
Field& Fields::object(std::string key, T& target, std::string doc) {
  const auto read = [&target](const Value& v, const Field& field, Reader& reader) {
    Fields inner = fields_of(target);
    reader.bind(v, inner, field.key);
  };
  const auto write = [&target] { return to_value(fields_of(target)); };
  return add(std::move(key), std::move(doc), object_shape<T>(), read, write);
}

template <class T>
Field& Fields::optional_object(std::string key, std::optional<T>& target, std::string doc) {
  const auto read = [&target](const Value& v, const Field& field, Reader& reader) {
    if (v.is_null()) return target.reset();
    if (!target) target.emplace();
    Fields inner = fields_of(*target);
    reader.bind(v, inner, field.key);
  };
  const auto write = [&target] { return target ? to_value(fields_of(*target)) : Value(); };
  Shape shape = object_shape<T>();
  shape.nullable = true;
  return add(std::move(key), std::move(doc), std::move(shape), read, write);
}

template <class T>
Field& Fields::list(std::string key, std::vector<T>& target, std::string doc) {
  const auto read = [&target](const Value& v, const Field& field, Reader& reader) {
    if (!reader.list(v, field)) return;
    target.clear();
    for (std::size_t i = 0; i < v.items.size(); ++i) {
      T& item = target.emplace_back();
      Fields inner = fields_of(item);
      reader.bind(v.items[i], inner, entry_context(field.key, i, v.items[i]));
    }
  };
  const auto write = [&target] {
    Value items = Value::sequence();
    for (T& item : target) items.items.push_back(to_value(fields_of(item)));
    return items;
  };
  return add(std::move(key), std::move(doc), list_shape(object_shape<T>()), read, write);
}

template <class T>
Field& Fields::map(std::string key, std::map<std::string, T>& target, std::string doc) {
  const auto read = [&target](const Value& v, const Field& field, Reader& reader) {
    if (!v.is_map()) return reader.unexpected(v, field);
    target.clear();
    for (const Value::Entry& e : v.entries) {
      Fields inner = fields_of(target[e.key]);
      reader.bind(e.value, inner, field.key + " '" + e.key + "'");
    }
  };
  const auto write = [&target] {
    Value named = Value::map();
    for (auto& [name, item] : target) named.set(name, to_value(fields_of(item)));
    return named;
  };
  Shape shape = list_shape(object_shape<T>());
  shape.form = Shape::Form::map;
  return add(std::move(key), std::move(doc), std::move(shape), read, write);
}

template <class Base>
Shape component_shape() {
  Shape s = simple_shape(Shape::Form::component);
  s.kind = &Registry<Base>::kind();
  return s;
}

template <class Pointer>
Field& Fields::component(std::string key, Pointer& target, std::string doc) {
  using Base = std::remove_const_t<typename Pointer::element_type>;
  const auto read = [&target](const Value& v, const Field& field, Reader& reader) {
    if (v.is_null()) return target.reset();
    auto made = reader.component(v, *field.shape.kind, const_cast<Base*>(target.get()), field.key);
    if (made) target = Registry<Base>::downcast(std::move(made));
  };
  const auto write = [&target] { return to_value(target.get()); };
  Shape shape = component_shape<Base>();
  shape.nullable = true;
  return add(std::move(key), std::move(doc), std::move(shape), read, write);
}

template <class Pointer>
Field& Fields::component_list(std::string key, std::vector<Pointer>& target, std::string doc) {
  using Base = std::remove_const_t<typename Pointer::element_type>;
  const auto read = [&target](const Value& v, const Field& field, Reader& reader) {
    if (!reader.list(v, field)) return;
    target.clear();
    for (std::size_t i = 0; i < v.items.size(); ++i) {
      const std::string entry = field.key + "[" + std::to_string(i) + "]";
      auto made = reader.component(v.items[i], *field.shape.entry->kind, nullptr, entry);
      if (made) target.push_back(Registry<Base>::downcast(std::move(made)));
    }
  };
  const auto write = [&target] {
    Value items = Value::sequence();
    for (const Pointer& p : target) items.items.push_back(to_value(p.get()));
    return items;
  };
  return add(std::move(key), std::move(doc), list_shape(component_shape<Base>()), read, write);
}

}  // namespace tack
