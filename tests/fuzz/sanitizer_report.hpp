// Reports of the sanitizers in a run of the program.
#pragma once

#include <string>

namespace tack {

bool has_sanitizer_report(const std::string& printed);

// The same without what is no fault in the fork that reads a mesh: crashes within other libraries,
// for which the fork is there, and requests for more memory than there is, which end it with the
// address sanitizer instead of an exception.
bool has_report_of_ours(const std::string& printed);

}  // namespace tack
