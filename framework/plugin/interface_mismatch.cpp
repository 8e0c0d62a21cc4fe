#include "framework/plugin/interface_mismatch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <sstream>

#include "framework/plugin/interface.hpp"
#include "framework/plugin/shared_library.hpp"
#include "geometry/errors.hpp"

namespace tack {

std::string interface_mismatch(const std::string& path) {
  std::optional<std::string> note = library_section(path, TACK_PLUGIN_SECTION);
  if (!note)
    throw InputError(fmt::format("'{}' is no plugin of tack; link it with the CMake target tack::plugin (docs/plugins.md)", path));
  note->resize(std::min(note->find('\0'), note->size()));
  std::istringstream theirs(*note), ours(TACK_PLUGIN_INTERFACE);
  std::string a, b;
  while (std::getline(ours, b)) {
    if (!std::getline(theirs, a)) a = "nothing";
    if (a != b) return fmt::format("it was built for {}, this program is {}", a, b);
  }
  return "";
}

}  // namespace tack
