// tack list --reference, --schema, ...: writes the reference pages and the JSON schemas.
#include <filesystem>

#include "framework/app/commands.hpp"
#include "framework/batch/batch_config.hpp"
#include "framework/calibrate/calibrate_config.hpp"
#include "framework/compare/compare_config.hpp"
#include "framework/config/describe.hpp"
#include "framework/experiment/experiment.hpp"
#include "framework/plot/figure_style.hpp"
#include "geometry/io/replace_file.hpp"

namespace tack {
namespace {

namespace fs = std::filesystem;

// Writes one page if the path ends in .md, else a folder with a page per format and kind. Other
// files of the folder stay.
void write_reference(const fs::path& path) {
  const Fields scene = prototype<Experiment>(), comparison = prototype<CompareConfig>(),
               batch = prototype<BatchConfig>(), calibration = prototype<CalibrateConfig>();
  const std::vector<FileFormat> formats = {
      {"scene", "Scene files", "Read by `tack run`, `check` and `view`; by topic: [scenes](../scenes.md).", &scene},
      {"comparison", "Comparison files", "Read by `tack compare`; see [comparing](../comparing.md).", &comparison},
      {"batch", "Batch files", "Read by `tack batch`; see [batches](../batches.md). Variations: [variation](variation.md).", &batch},
      {"calibration", "Calibration files", "Read by `tack calibrate`; see [calibration](../calibration.md).", &calibration}};
  if (path.extension() != ".md") {
    fs::create_directories(path);
    for (const auto& [file, text] : reference_pages(formats)) replace_file(path / file, text);
    return;
  }
  std::string page = reference_page(scene, "Scene file reference");
  for (size_t i = 1; i < formats.size(); ++i)
    page += "\n## " + formats[i].title + "\n\n" + parameter_table(*formats[i].keys);
  replace_file(path, page);
}

}  // namespace

int describe_command(const ListOptions& o) {
  if (!o.reference.empty()) write_reference(o.reference);
  if (!o.schema.empty())
    replace_file(o.schema, json_schema(prototype<Experiment>(), "tack scene") + "\n");
  if (!o.compare_schema.empty())
    replace_file(o.compare_schema, json_schema(prototype<CompareConfig>(), "tack comparison") + "\n");
  if (!o.batch_schema.empty())
    replace_file(o.batch_schema, json_schema(prototype<BatchConfig>(), "tack batch") + "\n");
  if (!o.calibrate_schema.empty())
    replace_file(o.calibrate_schema, json_schema(prototype<CalibrateConfig>(), "tack calibration") + "\n");
  if (!o.plot_schema.empty())
    replace_file(o.plot_schema, json_schema(prototype<FigureStyle>(), "tack plot style") + "\n");
  return exit_done;
}

}  // namespace tack
