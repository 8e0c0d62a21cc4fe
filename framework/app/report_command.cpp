// tack report: one HTML file for a run, several runs, a comparison or a batch.
#include <fmt/format.h>

#include "framework/app/commands.hpp"
#include "framework/output/provenance.hpp"
#include "framework/report/report.hpp"

namespace tack {

int report_command(const ReportOptions& options) {
  ReportSettings settings;
  settings.folders.assign(options.folders.begin(), options.folders.end());
  settings.output = options.output;
  settings.frames = options.frames;
  settings.cases = options.cases;
  settings.version = this_build().version;
  settings.commit = this_build().revision();
  const WrittenReport written = write_report(settings);
  for (const std::string& note : written.notes) fmt::print("note: {}\n", note);
  fmt::print("{}\n", written.path.string());
  return exit_done;
}

}  // namespace tack
