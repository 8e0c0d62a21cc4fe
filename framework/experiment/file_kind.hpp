// What a file is for: each command reads files of one kind, and says which command it is for that reads this one.
#pragma once

#include <string>

#include "framework/config/value.hpp"

namespace tack {

enum class FileKind { scene, batch, comparison, calibration };

// By its keys; of anything else, `wanted`.
FileKind kind_of_file(const Value& root, FileKind wanted);

// Throws InputError with the place and the command to call.
void refuse_other_kind(const Value& root, FileKind wanted);

}  // namespace tack
