// tack render: pictures and films of runs.
#include <fmt/format.h>

#include "framework/app/commands.hpp"
#include "framework/config/bind.hpp"
#include "framework/config/parse.hpp"
#include "framework/output/provenance.hpp"
#include "framework/report/render.hpp"

namespace tack {

int render_command(const RenderOptions& options) {
  const Value root = with_overrides(options.view.empty() ? Value::map() : parse_file(options.view), options.overrides);
  RenderView view;
  bind(root, view, "the view");
  RenderSettings settings;
  settings.folders.assign(options.folders.begin(), options.folders.end());
  settings.output = options.output;
  settings.with_blender = options.with == "blender";
  settings.quiet = options.quiet;
  settings.version = this_build().version;
  settings.commit = this_build().revision();
  render(settings, view);
  fmt::print("{}\n", options.output);
  return exit_done;
}

}  // namespace tack
