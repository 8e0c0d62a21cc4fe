#include "framework/report/render.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <limits>
#include <regex>

#include "framework/config/bind.hpp"
#include "framework/output/output_format.hpp"
#include "framework/output/pvd.hpp"
#include "framework/report/report.hpp"
#include "framework/report/scratch_folder.hpp"
#include "geometry/errors.hpp"
#include "geometry/io/frame_file.hpp"
#include "geometry/io/replace_file.hpp"
#include "geometry/own_library.hpp"
#include "geometry/run_program.hpp"

namespace tack {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr int frame_count_max = 5000;  // limit of the frames read of a run
constexpr RenderQuality picture_quality{.lights = 48, .samples = 128}, film_quality{.lights = 8, .samples = 32};

// Returns the node modules of the build tree or the installation.
fs::path modules() {
  std::error_code none;
  const fs::path installed = own_root() / "share" / "tack";
  return fs::exists(installed / "node_modules", none) ? installed : own_root() / "report";
}

// Returns the end of a text file.
std::string last_lines(const fs::path& path) {
  constexpr std::streamoff size = 1500;
  std::ifstream in(path, std::ios::ate);
  in.seekg(std::max<std::streamoff>(0, static_cast<std::streamoff>(in.tellg()) - size));
  return {std::istreambuf_iterator<char>(in), {}};
}

// Returns true for a film as numbered pictures, "film_%04d.png".
bool is_numbered(const fs::path& output) { return std::regex_search(output.filename().string(), std::regex("%0[0-9]+d")); }

// Returns the arguments of ffmpeg that code a film, between its input and its output.
std::vector<std::string> film_coding(const fs::path& output) {
  if (output.extension() == ".gif") return {"-filter_complex", "split[a][b];[a]palettegen=stats_mode=diff[p];[b][p]paletteuse=dither=sierra2_4a", "-loop", "0"};
  return {"-c:v", "libx264", "-preset", "medium", "-crf", "18", "-pix_fmt", "yuv420p", "-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-movflags", "+faststart"};
}

// Throws InputError if a program that was run is missing or failed.
void check_exit(int code, const char* program, const char* package, const fs::path& output) {
  const char* script = is_installed() ? "" : ", or run `./tack render`, which installs it";
  if (could_not_start(code)) throw InputError(fmt::format("{} is missing; install it (Debian: {}){}", program, package, script));
  if (code != 0) throw InputError(fmt::format("{} was not drawn", output.string()));
}

// Labels are names of folders, which need not be UTF-8.
void write_view(const fs::path& path, const Json& view) { replace_file(path, view.dump(-1, ' ', false, Json::error_handler_t::replace)); }

// Returns the frames of a run in the order of time, at least one.
std::vector<PvdFile::Frame> frames_of(const fs::path& run) {
  std::vector<PvdFile::Frame> frames = PvdFile::continued(run / "run.pvd", std::numeric_limits<double>::infinity()).list();
  if (frames.empty()) throw InputError(fmt::format("{} has no frames; let its scene write some (output.frames)", run.string()));
  return frames;
}

// Returns true if a field goes by this name: that of its array, or its label on the page (report/src/frames.js).
bool is_called(const FrameArray& field, const std::string& name) {
  std::string label = field.name;
  std::replace(label.begin(), label.end(), '_', ' ');
  if (field.components > 1) label = field.name == "velocity" ? "speed" : label + " (magnitude)";
  return name == field.name || name == label;
}

// Throws InputError for a field that the first frame of a run lacks.
void check_field(const std::string& name, const fs::path& run, const PvdFile::Frame& first) {
  FrameFile frame = read_frame(run / first.file);
  std::vector<FrameArray> fields = std::move(frame.vertex_arrays);
  std::copy_if(frame.cell_arrays.begin(), frame.cell_arrays.end(), std::back_inserter(fields), [](const FrameArray& a) { return a.name != "object"; });
  if (std::any_of(fields.begin(), fields.end(), [&](const FrameArray& a) { return is_called(a, name); })) return;
  std::vector<std::string> names;
  for (const FrameArray& a : fields) names.push_back(a.name);
  throw InputError(fmt::format("field: '{}' has no '{}'; its frames have {} (output.fields)", run.string(), name, names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "))));
}

// Prints which frame is drawn for a time [s] that is outside a run.
void print_frame_outside(double at, const fs::path& run, const std::vector<PvdFile::Frame>& frames) {
  constexpr double round_off = 1e-9;  // relative
  const double first = frames.front().time, last = frames.back().time;
  const auto after = [](double a, double b) { return a - b > round_off * std::max(std::abs(a), std::abs(b)); };
  if (after(at, last)) fmt::print(stderr, "note: at: {:g} s is after the end of {}; its last frame, at t = {:g} s, is drawn\n", at, run.string(), last);
  if (after(first, at)) fmt::print(stderr, "note: at: {:g} s is before the start of {}; its first frame, at t = {:g} s, is drawn\n", at, run.string(), first);
}

void draw_in_browser(const RenderSettings& settings, const Json& view, const ScratchFolder& scratch) {
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
  write_view(view_file, view);
  std::fflush(nullptr);
  check_exit(run_program({"node", shared_file("render.mjs").string(), modules().string(), report.output.string(), view_file.string(), settings.output.string()},
                         {{}, settings.quiet ? "/dev/null" : ""}),
             "node", "nodejs", settings.output);
}

// Draws the pictures by Blender; a film is made of them by ffmpeg.
void draw_in_blender(const RenderSettings& settings, const Json& view, const ScratchFolder& scratch) {
  Value format = Value::map();
  format.set("type", Value::scalar("npy"));
  const fs::path view_file = scratch.path() / "view.json", log = scratch.path() / "blender.txt";
  std::vector<std::string> shapes;
  for (const fs::path& folder : settings.folders) {
    shapes.push_back(scratch.path() / fmt::format("shapes_{}", shapes.size()));
    for (const std::string& note : bind_component<OutputFormat>(format)->write(folder, shapes.back()).notes)
      if (!settings.quiet) fmt::print("note: {}\n", note);
  }
  write_view(view_file, view);
  const bool film = settings.output.extension() != ".png";
  const fs::path pictures = film ? scratch.path() / "film_%06d.png" : fs::absolute(settings.output);
  std::fflush(nullptr);
  std::vector<std::string> command{"blender", "-b", "--factory-startup", "-P", shared_file("blender.py").string(), "--", view_file.string(), pictures.string()};
  command.insert(command.end(), shapes.begin(), shapes.end());
  const int code = run_program(command, {{}, log, true});
  if (code != 0 && !could_not_start(code)) fmt::print(stderr, "{}\n", last_lines(log));
  check_exit(code, "blender", "blender", settings.output);
  if (!film) return;
  std::vector<std::string> words{"ffmpeg", "-y", "-loglevel", "error", "-framerate", fmt::format("{:g}", view["fps"].get<double>()), "-i", pictures.string()};
  for (const std::string& word : film_coding(settings.output)) words.push_back(word);
  words.push_back(fs::absolute(settings.output).string());
  check_exit(run_program(words), "ffmpeg", "ffmpeg", settings.output);
}

}  // namespace

void render(const RenderSettings& settings, const RenderView& view) {
  const std::string ending = settings.output.extension().string();
  if (ending != ".png" && ending != ".mp4" && ending != ".gif")
    throw InputError(fmt::format("{}: names of pictures end in .png, names of films in .mp4 or .gif; give one with -o", settings.output.string()));
  if (view.background == "transparent" && ending != ".png")
    throw InputError(fmt::format("{}: films have no transparent background; draw numbered pictures (-o film_%04d.png)", settings.output.string()));
  for (const fs::path& folder : settings.folders)
    if (kind_of(folder) != FolderKind::run) throw InputError(fmt::format("{}: only runs can be rendered; give the folder of a run", folder.string()));
  settings.with_blender ? check_blender(view) : check_built_in(view);
  const bool film = ending != ".png" || is_numbered(settings.output);
  std::vector<double> times;  // of the frames of the run that ends last
  for (const fs::path& folder : settings.folders) {
    const std::vector<PvdFile::Frame> frames = frames_of(folder);
    if (view.field) check_field(view.field->name, folder, frames.front());
    if (view.at && !film && !settings.quiet) print_frame_outside(*view.at, folder, frames);
    if (!times.empty() && frames.back().time <= times.back()) continue;
    times.clear();
    for (const PvdFile::Frame& frame : frames) times.push_back(frame.time);
  }
  if (film) times = film_times(view, times);
  if (settings.output.has_parent_path()) fs::create_directories(settings.output.parent_path());
  const ScratchFolder scratch;
  if (!view.labels.empty() && view.labels.size() != settings.folders.size())
    throw InputError(fmt::format("labels: {} for {} runs; give one for each", view.labels.size(), settings.folders.size()));
  Json json = json_of(view, film ? film_quality : picture_quality);
  if (settings.with_blender && view.labels.empty() && settings.folders.size() > 1) json["labels"] = labels_of(settings.folders);
  json["film_coding"] = film_coding(settings.output);
  if (film) json["times"] = times;
  settings.with_blender ? draw_in_blender(settings, json, scratch) : draw_in_browser(settings, json, scratch);
}

}  // namespace tack
