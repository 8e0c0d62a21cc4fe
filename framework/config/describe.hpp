// Texts generated from fields: terminal help, the reference page, the JSON schema for editors and
// the echo of a resolved scene.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "framework/config/field.hpp"

namespace tack {

// Text of `tack list [KIND [NAME]]`: all kinds, the components of one kind, or the parameters of
// one component. Throws InputError with the nearest name for an unknown kind or component.
std::string list_kinds();
std::string list_kind(const std::string& kind);
std::string list_component(const std::string& kind, const std::string& name);
// Returns the list of components of that name, of any kind; "" for a kind's name or if there are
// none.
std::string list_named(const std::string& name);

// Returns a Markdown table of the parameters of `root`.
std::string parameter_table(const Fields& root);

// Returns Markdown: the parameters of `root` (the scene), then every registered kind and component.
std::string reference_page(const Fields& root, const std::string& title);

// Returns the JSON schema, draft 7, of files that bind to `root`.
std::string json_schema(const Fields& root, const std::string& title);

// Returns every value, defaults included, in SI with its unit as comment. Binding this text gives
// the same values bit for bit.
std::string to_yaml(const Fields& fields);

// Returns the default of a field for readers: "5e6", "fang", "required", "unset".
std::string default_text(const Field& field);

// Returns the struct inside an object, list or map of objects; nullptr for other shapes.
const Shape* nested_object(const Shape& shape);

}  // namespace tack
