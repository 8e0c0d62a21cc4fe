// Texts generated from fields: terminal help, the pages of the reference, the JSON schema for
// editors and the echo of a resolved scene.
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

// Returns one page of Markdown: the parameters of `root` (the scene), then every registered kind
// and component.
std::string reference_page(const Fields& root, const std::string& title);

// A kind of file that users write, as a page of the reference.
struct FileFormat {
  std::string name;    // name of its page without the ending: "scene"
  std::string title;   // "Scene files"
  std::string about;   // one sentence, Markdown
  const Fields* keys;  // not null
};

// Returns the pages of the reference (Markdown) by file name: "README.md", the index; one page per
// format; one page per registered kind, named after it, in which each component has its name as
// anchor.
std::map<std::string, std::string> reference_pages(const std::vector<FileFormat>& formats);

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
