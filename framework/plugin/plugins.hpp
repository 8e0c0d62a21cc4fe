// Plugins: shared libraries from outside the tree that register components when they are loaded
// (docs/plugins.md).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "framework/config/value.hpp"

namespace tack {

struct Plugin {
  std::string path;            // absolute, without links
  std::uint32_t checksum = 0;  // of the file
};
// Returns the plugins in the order in which they were loaded.
const std::vector<Plugin>& loaded_plugins();

// Loads a library, unless it is loaded already. Its build interface is read from the file before
// any of its code runs, and a rejected library leaves nothing registered. Throws InputError,
// without a source location: file not found, no plugin, built for another tack, or component names
// in use.
void load_plugin(const std::string& path);

// Loads the plugins that a file names under `plugins`, before the rest of the file is bound. Throws
// InputError with their source locations. A value that is no list of paths is left to the binding
// of the key, which reports it.
void load_plugins(const Value& root);

inline constexpr const char* plugins_doc =
    "shared libraries with custom components, loaded before the rest is read";

}  // namespace tack
