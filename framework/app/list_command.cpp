// tack list: what can be named in a scene file; also writes the reference page and the JSON schema.
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>

#include "framework/app/commands.hpp"
#include "framework/batch/batch_config.hpp"
#include "framework/calibrate/calibrate_config.hpp"
#include "framework/compare/compare_config.hpp"
#include "framework/config/describe.hpp"
#include "framework/experiment/experiment.hpp"
#include "framework/plugin/plugins.hpp"
#include "geometry/io/replace_file.hpp"

namespace tack {

int list_command(const ListOptions& o) {
  for (const std::string& plugin : o.plugins) load_plugin(std::filesystem::absolute(plugin).string());
  const std::string title = "Scene file reference";
  if (!o.reference.empty())
    replace_file(o.reference, reference_page(prototype<Experiment>(), title) +
                                "\n## Comparison files\n\nWhat `tack compare` reads; see [comparing.md](comparing.md).\n\n" +
                                parameter_table(prototype<CompareConfig>()) +
                                "\n## Batch files\n\nWhat `tack batch` reads; see [batches.md](batches.md). What varies: [variation](#variation).\n\n" +
                                parameter_table(prototype<BatchConfig>()) +
                                "\n## Calibration files\n\nWhat `tack calibrate` reads; see [calibration.md](calibration.md).\n\n" +
                                parameter_table(prototype<CalibrateConfig>()));
  if (!o.schema.empty())
    replace_file(o.schema, json_schema(prototype<Experiment>(), "tack scene") + "\n");
  if (!o.compare_schema.empty())
    replace_file(o.compare_schema, json_schema(prototype<CompareConfig>(), "tack comparison") + "\n");
  if (!o.batch_schema.empty())
    replace_file(o.batch_schema, json_schema(prototype<BatchConfig>(), "tack batch") + "\n");
  if (!o.calibrate_schema.empty())
    replace_file(o.calibrate_schema, json_schema(prototype<CalibrateConfig>(), "tack calibration") + "\n");
  if (!o.reference.empty() || !o.schema.empty() || !o.compare_schema.empty() || !o.batch_schema.empty() || !o.calibrate_schema.empty()) return exit_done;
  if (o.kind.empty()) {
    fmt::print("{}", list_kinds());
  } else {
    fmt::print("{}", o.name.empty() ? list_kind(o.kind) : list_component(o.kind, o.name));
  }
  return exit_done;
}

}  // namespace tack
