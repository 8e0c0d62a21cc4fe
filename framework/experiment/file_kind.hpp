// Kinds of input files. Each command reads files of one kind; for another kind, it names the
// command that reads it.
#pragma once

#include <string>

#include "framework/config/value.hpp"

namespace tack {

enum class FileKind { scene, batch, comparison, calibration };

// Returns the kind of a file by its keys; `wanted` if they do not determine it.
FileKind kind_of_file(const Value& root, FileKind wanted);

// Throws InputError, with the source location and the right command, for another kind of file.
void refuse_other_kind(const Value& root, FileKind wanted);

}  // namespace tack
