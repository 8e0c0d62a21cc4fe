// The Markdown reference on one page: one table per struct and component.
#include <fmt/format.h>

#include "framework/config/describe.hpp"
#include "framework/config/reference_text.hpp"
#include "framework/config/words.hpp"

namespace tack {
namespace {

// Escapes bars, which would end a table cell.
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

// Writes the table of one struct, with a row per field of its nested structs.
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
  for (const auto& [name, entry] : kind.entries())
    out += fmt::format("\n### {} `{}`\n\n{}", kind.name(), name, component_text(kind, entry, KindLinks::anchors));
}

}  // namespace

std::string reference_page(const Fields& root, const std::string& title) {
  std::string out = fmt::format("# {}\n\n{}\n{}", title, reference_conventions, parameter_table(root));
  for (const Kind* kind : registered_kinds()) write_kind(*kind, out);
  return out;
}

}  // namespace tack
