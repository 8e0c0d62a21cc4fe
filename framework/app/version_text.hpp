// Text that `--version` prints.
#pragma once

#include <fmt/format.h>

#include <string>

#include "framework/output/provenance.hpp"

namespace tack {

// Returns the version, the state of the sources, the compiler and its flags.
inline std::string version_text() {
  const Build build = this_build();
  return fmt::format("tack {} ({})\n{}, {}; {}", build.version, build.sources(), build.compiler,
                     build.flags, build.instruction_set);
}

}  // namespace tack
