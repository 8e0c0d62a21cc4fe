// Components from outside of the tree: shared libraries that register them when they are loaded (docs/plugins.md).
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
// In the order in which they were loaded.
const std::vector<Plugin>& loaded_plugins();

// Loads a library, unless it is loaded already. What it was built against is read from the file before any of it runs, and
// a library that is refused leaves nothing behind. Throws InputError, without a place: no such file, no plugin, one for
// another tack, one whose names are taken.
void load_plugin(const std::string& path);

// Those that a file names under `plugins`, before anything else of it is read. Throws InputError with their places. What is
// no list of paths is left for the one who binds the key.
void load_plugins(const Value& root);

inline constexpr const char* plugins_doc = "shared libraries with custom components, loaded before the rest is read";

}  // namespace tack
