// Scene files to Value trees: includes, command-line overrides, relative paths.
//
// `include: other.yaml`, or a list of files, at the top level of a file merges the included files
// (merge.hpp): later ones over earlier ones, the including file over all. All errors are
// InputErrors that open with file:line:column.
#pragma once

#include <string>
#include <vector>

#include "framework/config/merge.hpp"

namespace tack {

Value parse_file(const std::string& path);

// Parses a text. name: stands for the file in messages, includes and relative paths.
Value parse_string(const std::string& text, const std::string& name);

// Applies `--set a.b=c`: the value, parsed as YAML, replaces the one at the dotted path:
//    segment in a list            index, or `name` of an entry (`objects.plate.shape.size`)
//    key that does not exist      created (binding checks it)
//    component as a bare name     becomes a map
//    name of a parameter alone    the parameter, unless it is a key of the file
void apply_override(Value& root, const std::string& assignment);

Value with_overrides(Value root, const std::vector<std::string>& assignments);

// Replaces the value at `path` by a value read elsewhere, which keeps its marks.
void set_at(Value& root, const std::string& path, Value value);

// Returns the value at a dotted path; nullptr if there is none.
const Value* value_at(const Value& root, const std::string& path);

// Returns the absolute form of a path written at `mark`: relative to the folder of its file, or to
// the working directory if it is in no file. An empty path stays empty.
std::string resolve_path(const SourceMark& mark, const std::string& path);

}  // namespace tack
