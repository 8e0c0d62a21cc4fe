#include "framework/config/reference_text.hpp"

#include <fmt/format.h>

#include "framework/config/describe.hpp"
#include "framework/config/retired_keys.hpp"

namespace tack {
namespace {

std::string kind_link(const Shape& shape, KindLinks links) {
  const Shape& entry = shape.entry ? *shape.entry : shape;
  std::string noun = shape.noun();
  if (!entry.kind) return noun;
  const std::string& kind = entry.kind->name();
  return fmt::format("[{}]({})", noun, links == KindLinks::anchors ? "#" + kind : kind + ".md");
}

std::string meaning(const Field& f, const Fields& fields) {
  std::string text = f.doc;
  for (const Shape::Option& o : f.shape.options) text += fmt::format("<br>`{}`: {}", o.name, o.doc);
  if (!f.instead.empty()) text += fmt::format("<br>Deprecated: {}", f.instead);
  for (const std::string& name : retired_names(f, fields))
    text += fmt::format("<br>Deprecated name: `{}`", name);
  return text;
}

}  // namespace

const char* const reference_conventions =
    "Numbers may carry a unit (`5 MPa`, `0.1 mm`, `30 deg`); without one they are in the SI unit shown.\n"
    "A component is chosen by `type`; its bare name is short for a map with only `type`.\n"
    "`include: FILE`, or a list of files, merges other files under this one:\n\n"
    "- Maps are merged key by key.\n"
    "- Lists whose entries have a `name` (or `between`, of pairs) are merged entry by entry; `remove: true` removes the\n"
    "  entry of that name, `replace: true` replaces it instead of merging.\n"
    "- Other lists are replaced.\n\n"
    "A deprecated name of a key is accepted with a warning; both names in one map are an error.\n";

const char* const parameter_header =
    "| key | value | default | range | meaning |\n| --- | --- | --- | --- | --- |\n";

std::string table_cell(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '|' ? std::string("\\|") : std::string(1, c);
  return out;
}

void append_rows(const Fields& fields, const std::string& prefix, KindLinks links, bool nested,
                 std::string& out) {
  for (const Field& f : fields.all()) {
    const Shape* inner = nested_object(f.shape);
    const bool no_default = inner && !f.mandatory && !f.shape.nullable;
    const std::string initial = no_default ? "" : default_text(f);
    const bool is_value = !f.mandatory && !initial.empty() && initial != "unset";
    out += fmt::format("| `{}{}` | {} | {} | {} | {} |\n", prefix, f.key,
                       table_cell(kind_link(f.shape, links)),
                       is_value ? "`" + table_cell(initial) + "`" : initial, f.constraint(),
                       table_cell(meaning(f, fields)));
    const std::string many = f.shape.form == Shape::Form::object ? "." : "[].";
    if (inner && nested) append_rows(inner->prototype(), fmt::format("{}{}{}", prefix, f.key, many), links, nested, out);
  }
}

std::string parameter_table(const Fields& fields, KindLinks links) {
  if (fields.all().empty()) return "No parameters.\n";
  std::string out = parameter_header;
  append_rows(fields, "", links, true, out);
  return out;
}

std::string parameter_table(const Fields& fields) { return parameter_table(fields, KindLinks::anchors); }

std::string component_text(const Kind& kind, const Kind::Entry& entry, KindLinks links) {
  std::string out = entry.doc + "\n";
  if (const std::string traits = entry.factory()->traits_text(); !traits.empty()) out += traits + ".\n";
  if (!entry.source.empty()) out += fmt::format("Source: {}.\n", entry.source);
  return out + fmt::format("Code: `{}`.\n\n{}", entry.file, parameter_table(kind.prototype(entry.name), links));
}

}  // namespace tack
