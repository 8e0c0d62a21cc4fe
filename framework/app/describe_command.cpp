// tack list --reference, --schema, ...: the reference page and the JSON schemas, as files.
#include "framework/app/commands.hpp"
#include "framework/batch/batch_config.hpp"
#include "framework/calibrate/calibrate_config.hpp"
#include "framework/compare/compare_config.hpp"
#include "framework/config/describe.hpp"
#include "framework/experiment/experiment.hpp"
#include "framework/plot/plot_look.hpp"
#include "geometry/io/replace_file.hpp"

namespace tack {

int describe_command(const ListOptions& o) {
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
  if (!o.plot_schema.empty())
    replace_file(o.plot_schema, json_schema(prototype<PlotLook>(), "tack plot style") + "\n");
  return exit_done;
}

}  // namespace tack
