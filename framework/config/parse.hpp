// Scene files to Value trees: includes, command-line overrides, relative paths.
//
// `include: other.yaml`, or a list of files, at the top level of a file merges those files under
// it, later ones over earlier ones, the including file over all, as merge.hpp says. All errors are InputErrors that open with file:line:column.
#pragma once

#include <string>
#include <vector>

#include "framework/config/merge.hpp"

namespace tack {

Value parse_file(const std::string& path);

// `name` stands for the file: in messages, and as what includes and relative paths are relative to.
Value parse_string(const std::string& text, const std::string& name);

// Applies `--set a.b=c`: the value, parsed as YAML, replaces the one at the dotted path. A segment
// indexes a list by number or by the `name` of its entries (`objects.plate.shape.size`); keys that
// do not exist are created (binding checks them); a component written as a bare name becomes a map. One of the file's `parameters` may go by its name
// alone, where that is no key of the file.
void apply_override(Value& root, const std::string& assignment);

Value with_overrides(Value root, const std::vector<std::string>& assignments);

// The same with a value that was read elsewhere, whose marks it keeps.
void set_at(Value& root, const std::string& path, Value value);

// The value at such a path; nullptr if there is none.
const Value* value_at(const Value& root, const std::string& path);

// The absolute form of a path written at `mark`: relative to the folder of that file, or to the
// working directory for values that stand in no file. An empty path stays empty.
std::string resolve_path(const SourceMark& mark, const std::string& path);

}  // namespace tack
