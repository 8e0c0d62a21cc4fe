// tack export: the shapes of a run in a file format of other programs.
#include <fmt/format.h>

#include <filesystem>

#include "framework/app/commands.hpp"
#include "framework/config/bind.hpp"
#include "framework/config/parse.hpp"
#include "framework/output/output_format.hpp"
#include "framework/plugin/plugins.hpp"
#include "geometry/errors.hpp"

namespace tack {

int export_command(const ExportOptions& options) {
  for (const std::string& plugin : options.plugins) load_plugin(std::filesystem::absolute(plugin).string());
  try {
    Registry<OutputFormat>::kind().entry(options.format);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}; pc2 is for Blender, usd for Houdini, gltf for browsers, obj and ply for any other", error.what()));
  }
  Value value = Value::map();
  value.mark.file = std::make_shared<const std::string>("tack export --to " + options.format);
  value.set("type", Value::scalar(options.format));
  for (const std::string& setting : options.settings) {
    if (setting.find('=') == setting.npos) throw InputError(fmt::format("'{}': expects key=value, such as fps=24 or objects=[cube]", setting));
    apply_override(value, setting);
  }
  const Exported made = bind_component<OutputFormat>(value)->write(options.folder, options.output);
  if (made.paths.empty()) fmt::print("{}: the run has written its frames as {}\n", (std::filesystem::path(options.folder) / "run.pvd").string(), options.format);
  for (const auto& path : made.paths) fmt::print("{}\n", path.string());
  for (const std::string& note : made.notes) fmt::print("note: {}\n", note);
  return exit_done;
}

}  // namespace tack
