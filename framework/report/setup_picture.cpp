#include "framework/report/setup_picture.hpp"

#include <fmt/format.h>

#include "framework/config/describe.hpp"
#include "framework/experiment/built_experiment.hpp"
#include "framework/output/frame_geometry.hpp"
#include "framework/output/pvd.hpp"
#include "framework/output/run_folder.hpp"
#include "framework/output/vtu.hpp"
#include "framework/report/render.hpp"
#include "framework/report/scratch_folder.hpp"
#include "geometry/errors.hpp"
#include "geometry/io/replace_file.hpp"

namespace tack {

namespace fs = std::filesystem;

void draw_setup(LoadedExperiment loaded, const fs::path& output) {
  if (output.extension() != ".png") throw InputError(fmt::format("{}: names of pictures end in .png", output.string()));
  BuiltExperiment built(std::move(loaded));
  const World& world = built.world();
  const ScratchFolder scratch;
  const fs::path folder = scratch.path() / "setup";
  const fs::path frame = RunFolder::frame(0);
  fs::create_directories((folder / frame).parent_path());
  const FrameGeometry geometry = frame_geometry(world);
  write_vtu((folder / frame).string(), geometry, world.start.x.head(3 * geometry.vertices), 0, {}, {});
  PvdFile(folder / "run.pvd").add(0, frame);
  replace_file(folder / "scene.yaml", to_yaml(fields_of(built.experiment())));
  RenderSettings settings;
  settings.folders = {folder};
  settings.output = output;
  settings.quiet = true;
  render(settings, RenderView());
}

}  // namespace tack
