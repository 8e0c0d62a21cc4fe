// Markdown blocks that the one-page reference and the reference folder share.
#pragma once

#include <string>

#include "framework/config/field.hpp"
#include "framework/config/registry.hpp"

namespace tack {

// Targets of links to a kind: an anchor of the same page (#energy), or its own page (energy.md).
enum class KindLinks { anchors, pages };

// Units, `include` and `type`, which hold for every table.
extern const char* const reference_conventions;

// Returns a text as a cell of a table: bars escaped.
std::string table_cell(const std::string& text);

// Appends one row per field, keys with `prefix`; with `nested`, also a row per field of the structs
// inside.
void append_rows(const Fields& fields, const std::string& prefix, KindLinks links, bool nested,
                 std::string& out);

extern const char* const parameter_header;  // header of tables whose rows append_rows makes

// Returns the table of all fields, nested ones included, or "No parameters.".
std::string parameter_table(const Fields& fields, KindLinks links);

// Returns a component's sentence, traits, source, file and parameters.
std::string component_text(const Kind& kind, const Kind::Entry& entry, KindLinks links);

}  // namespace tack
