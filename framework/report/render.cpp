#include "framework/report/render.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <regex>

#include "framework/report/report.hpp"
#include "geometry/errors.hpp"
#include "geometry/io/replace_file.hpp"
#include "geometry/own_library.hpp"
#include "geometry/run_program.hpp"

namespace tack {
namespace {

namespace fs = std::filesystem;

constexpr int frame_count_max = 5000;  // limit of the frames read of a run
constexpr int lights_per_picture = 48, lights_per_film_frame = 8;

// A temporary folder, deleted with its owner.
class ScratchFolder {
 public:
  ScratchFolder() {
    std::string name = (fs::temp_directory_path() / "tack_render_XXXXXX").string();
    if (!::mkdtemp(name.data())) throw InputError(fmt::format("{}: cannot make a folder there; set TMPDIR", name));
    path_ = name;
  }
  ~ScratchFolder() {
    std::error_code none;
    fs::remove_all(path_, none);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

// Returns the node modules of the build tree or the installation.
fs::path modules() {
  std::error_code none;
  const fs::path installed = own_root() / "share" / "tack";
  return fs::exists(installed / "node_modules", none) ? installed : own_root() / "report";
}

// Returns true for a film as numbered pictures, "film_%04d.png".
bool is_numbered(const fs::path& output) { return std::regex_search(output.filename().string(), std::regex("%0[0-9]+d")); }

}  // namespace

void render(const RenderSettings& settings, const RenderView& view) {
  const std::string ending = settings.output.extension().string();
  if (ending != ".png" && ending != ".mp4" && ending != ".gif")
    throw InputError(fmt::format("{}: names of pictures end in .png, names of films in .mp4 or .gif; give one with -o", settings.output.string()));
  if (view.background == "transparent" && ending != ".png")
    throw InputError(fmt::format("{}: films have no transparent background; draw numbered pictures (-o film_%04d.png)", settings.output.string()));
  for (const fs::path& folder : settings.folders)
    if (kind_of(folder) != FolderKind::run) throw InputError(fmt::format("{}: only runs can be rendered; give the folder of a run", folder.string()));
  const ScratchFolder scratch;
  ReportSettings report;
  report.folders = settings.folders;
  report.output = scratch.path() / "film.html";
  report.frames = frame_count_max;
  report.page = shared_file("film.html");
  report.version = settings.version;
  report.commit = settings.commit;
  for (const std::string& note : write_report(report).notes)
    if (!settings.quiet) fmt::print("note: {}\n", note);
  const fs::path view_file = scratch.path() / "view.json";
  replace_file(view_file, json_of(view, ending == ".png" && !is_numbered(settings.output) ? lights_per_picture : lights_per_film_frame).dump());
  if (settings.output.has_parent_path()) fs::create_directories(settings.output.parent_path());
  std::fflush(nullptr);
  const int code = run_program({"node", shared_file("render.mjs").string(), modules().string(), report.output.string(), view_file.string(), settings.output.string()},
                               {{}, settings.quiet ? "/dev/null" : ""});
  if (code < 0 || code == 127) throw InputError("node is missing; install it (Debian: nodejs), or run `./tack render`, which installs it");
  if (code != 0) throw InputError(fmt::format("{} was not drawn", settings.output.string()));
}

}  // namespace tack
