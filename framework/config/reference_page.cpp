// The Markdown reference: one table per struct and component.
#include <fmt/format.h>

#include "framework/config/describe.hpp"
#include "framework/config/words.hpp"

namespace tack {
namespace {

// A bar would end the cell of a table.
std::string cell(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '|' ? std::string("\\|") : std::string(1, c);
  return out;
}

std::string kind_link(const Shape& shape) {
  const Shape& entry = shape.entry ? *shape.entry : shape;
  const std::string noun = shape.noun();
  return entry.kind ? fmt::format("[{}](#{})", noun, entry.kind->name()) : noun;
}

std::string meaning(const Field& f) {
  std::string text = f.doc;
  for (const Shape::Option& o : f.shape.options) text += fmt::format("<br>`{}`: {}", o.name, o.doc);
  return text;
}

// The table of one struct, with a row per field of the structs inside it.
void write_rows(const Fields& fields, const std::string& prefix, std::string& out) {
  for (const Field& f : fields.all()) {
    const Shape* inner = nested_object(f.shape);
    const bool no_default = inner && !f.mandatory && !f.shape.nullable;
    const std::string initial = no_default ? "" : default_text(f);
    const bool is_value = !f.mandatory && !initial.empty() && initial != "unset";
    out += fmt::format("| `{}{}` | {} | {} | {} | {} |\n", prefix, f.key, cell(kind_link(f.shape)),
                       is_value ? "`" + cell(initial) + "`" : initial, f.constraint(),
                       cell(meaning(f)));
    const std::string many = f.shape.form == Shape::Form::object ? "." : "[].";
    if (inner) write_rows(inner->prototype(), prefix + f.key + many, out);
  }
}

}  // namespace

std::string parameter_table(const Fields& fields) {
  if (fields.all().empty()) return "No parameters.\n";
  std::string out =
      "| key | value | default | range | meaning |\n| --- | --- | --- | --- | --- |\n";
  write_rows(fields, "", out);
  return out;
}

namespace {

void write_kind(const Kind& kind, std::string& out) {
  out += fmt::format("\n## {}\n\n{}\n", kind.name(), kind.doc());
  for (const auto& [name, entry] : kind.entries()) {
    out += fmt::format("\n### {} `{}`\n\n{}\n", kind.name(), name, entry.doc);
    if (const std::string traits = entry.factory()->traits_text(); !traits.empty()) out += traits + ".\n";
    if (!entry.source.empty()) out += fmt::format("Source: {}.\n", entry.source);
    out += fmt::format("Code: `{}`.\n\n{}", entry.file, parameter_table(kind.prototype(name)));
  }
}

}  // namespace

std::string reference_page(const Fields& root, const std::string& title) {
  std::string out = fmt::format(
      "# {}\n\nNumbers may carry a unit (`5 MPa`, `0.1 mm`, `30 deg`); without one they are in the "
      "SI "
      "unit shown.\n`include: FILE` or a list of files merges other files under this one: maps "
      "key by key, lists of\nentries with a `name` (or of pairs, `between`) entry by entry, where `remove: true` takes "
      "out the entry of that name and\n`replace: true` puts this one in its place; other lists are replaced. A component "
      "is chosen by `type`; its\nbare name is short for a map with only `type`.\n\n{}",
      title, parameter_table(root));
  for (const Kind* kind : registered_kinds()) write_kind(*kind, out);
  return out;
}

}  // namespace tack
