// tack list: the components that a scene file can name.
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>

#include "framework/app/commands.hpp"
#include "framework/config/describe.hpp"
#include "framework/plugin/plugins.hpp"

namespace tack {

int list_command(const ListOptions& o) {
  for (const std::string& plugin : o.plugins) load_plugin(std::filesystem::absolute(plugin).string());
  if (o.writes_files()) return describe_command(o);
  if (o.kind.empty()) {
    fmt::print("{}", list_kinds());
  } else if (o.name.empty()) {
    const std::string found = list_named(o.kind);
    fmt::print("{}", found.empty() ? list_kind(o.kind) : found);
  } else {
    fmt::print("{}", list_component(o.kind, o.name));
  }
  return exit_done;
}

}  // namespace tack
