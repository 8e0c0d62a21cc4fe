// What is written from the fields alone: help on the terminal, the reference page, the JSON schema
// for editors, and the echo of a resolved scene.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "framework/config/field.hpp"

namespace tack {

// `tack list [KIND [NAME]]`: all kinds, the components of one, or the parameters of one component.
// Throws InputError with the nearest name for an unknown kind or component.
std::string list_kinds();
std::string list_kind(const std::string& kind);
std::string list_component(const std::string& kind, const std::string& name);
// Returns the components of that name, of any kind; "" if there are none, or if it is the name of a
// kind.
std::string list_named(const std::string& name);

// Markdown: the parameters of `root` as a table.
std::string parameter_table(const Fields& root);

// Markdown, one page: the parameters of `root` (the scene), then every registered kind and component.
std::string reference_page(const Fields& root, const std::string& title);

// A kind of file that users write, as a page of the reference.
struct FileFormat {
  std::string name;    // name of its page without the ending: "scene"
  std::string title;   // "Scene files"
  std::string about;   // one sentence, Markdown
  const Fields* keys;  // not null
};

// Returns the pages of the reference (Markdown) by file name: "README.md", the index; one page per
// format; one page per registered kind, KIND.md, in which each component has its name as anchor.
std::map<std::string, std::string> reference_pages(const std::vector<FileFormat>& formats);

// JSON schema, draft 7, of files that bind to `root`.
std::string json_schema(const Fields& root, const std::string& title);

// Every value, defaults included, in SI with its unit as comment. Binding this text again gives the
// same values bit for bit.
std::string to_yaml(const Fields& fields);

// The default of a field for readers: "5e6", "fang", "required", "unset".
std::string default_text(const Field& field);

// The struct inside an object, list or map of objects; nullptr for anything else.
const Shape* nested_object(const Shape& shape);

}  // namespace tack
