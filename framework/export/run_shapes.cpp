#include "framework/export/run_shapes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "framework/config/file_digest.hpp"
#include "framework/config/read_file.hpp"
#include "framework/experiment/drawn_scene.hpp"
#include "framework/experiment/load_experiment.hpp"
#include "framework/export/source_faces.hpp"
#include "framework/output/file_names.hpp"
#include "framework/output/outer_vertices.hpp"
#include "framework/output/run_folder.hpp"
#include "geometry/errors.hpp"
#include "geometry/mesh/surface.hpp"

namespace tack {
namespace {

namespace fs = std::filesystem;

constexpr double rate_of_one_frame = 24;  // samples per second; that of films
constexpr double time_tolerance = 1e-9;   // of the distance of two samples

// Colours (sRGB) of objects in their order, which colour-blind people can tell apart: Okabe and Ito,
// Color Universal Design (2008); those of the 3D view of reports (report/src/theme.js).
const std::array<Vec3, 8> palette = {Vec3(0x00, 0x72, 0xB2) / 255, Vec3(0xE6, 0x9F, 0x00) / 255, Vec3(0x00, 0x9E, 0x73) / 255, Vec3(0xCC, 0x79, 0xA7) / 255,
                                     Vec3(0x56, 0xB4, 0xE9) / 255, Vec3(0xD5, 0x5E, 0x00) / 255, Vec3(0xF0, 0xE4, 0x42) / 255, Vec3(0x99, 0x99, 0x99) / 255};

// Returns the linear colour of an sRGB colour (IEC 61966-2-1).
Vec3 linear(const Vec3& srgb) {
  return srgb.unaryExpr([](double c) { return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4); });
}

// Adds the faces, edges and points of a frame to the objects. place: of each object of the scene
// among `objects`, -1: not exported. local: of each vertex, its number in its object.
void add_elements(const FrameFile& frame, const Surface& surface, const std::vector<int>& place, const std::vector<int>& local,
                  std::vector<ExportedObject>& objects) {
  const std::vector<int> of_vertex = objects_of_vertices(frame);
  const auto owner = [&](int v) { return place[of_vertex[v]]; };
  for (const Triangle& t : surface.triangles) {
    if (owner(t[0]) < 0) continue;
    ExportedObject& object = objects[owner(t[0])];
    object.face_sizes.push_back(3);
    object.face_material.push_back(0);
    for (const int v : t) object.corners.push_back(local[v]);
  }
  for (const Edge& e : frame.mesh.edges)
    if (owner(e[0]) >= 0) objects[owner(e[0])].edges.push_back({local[e[0]], local[e[1]]});
  for (const int v : frame.mesh.points)
    if (owner(v) >= 0) objects[owner(v)].points.push_back(local[v]);
}

// Returns the files that a scene reads.
std::vector<fs::path> files_of(const Value& scene) {
  std::vector<fs::path> files;
  std::error_code none;
  for (const std::string& path : named_paths(scene))
    if (fs::is_regular_file(path, none)) files.emplace_back(path);
  return files;
}

std::string unit_of_file(const Value& shape) {
  const Value* unit = shape.find("unit");
  return unit && unit->is_scalar() && unit->text != "m" ? unit->text : "";
}

}  // namespace

// Positions of one frame.
struct RunShapes::Loaded {
  int frame = -1;
  ObjectPositions positions;
};

RunShapes::RunShapes(const fs::path& results, const ShapeSelection& selection, const std::function<void(const std::vector<std::string>&)>& check)
    : frames_(results), fps_(selection.fps) {
  choose_times(selection);
  if (std::string note = frames_.unfinished_note(); !note.empty()) notes_.push_back(std::move(note));

  const std::string scene = (folder() / "scene.yaml").string();
  const LoadedExperiment loaded = parse_experiment(read_file(scene, largest_text), scene);
  const Experiment& experiment = loaded.experiment;
  sources_ = files_of(loaded.root);
  name_ = RunFolder::default_root(experiment.name).filename();
  up_ = up_direction(experiment);

  std::vector<std::string> names;
  for (const ObjectConfig& object : experiment.objects) names.push_back(object.name);
  check(names);
  FileNames file_names("_");
  std::vector<int> place(names.size(), -1);
  for (size_t i = 0; i < names.size(); ++i) {
    if (!selection.objects.empty() && std::find(selection.objects.begin(), selection.objects.end(), names[i]) == selection.objects.end()) continue;
    place[i] = static_cast<int>(objects_.size());
    numbers_.push_back(static_cast<int>(i));
    ExportedObject& object = objects_.emplace_back();
    object.name = names[i];
    object.file_name = file_names.of(names[i]);
    object.radius = drawn_radius(experiment.objects[i]).value_or(0);
    object.materials = {{object.file_name, linear(palette[i % palette.size()])}};
  }

  const FrameFile first = frames_.read(0);
  const Surface surface = extract_surface(first.mesh);
  const auto outer = outer_vertices(first, surface, static_cast<int>(names.size()));
  std::vector<int> local(first.mesh.vertices.size(), -1);
  for (size_t k = 0; k < objects_.size(); ++k) {
    const std::vector<int>& vertices = outer[numbers_[k]];
    objects_[k].vertices = static_cast<int>(vertices.size());
    for (size_t i = 0; i < vertices.size(); ++i) local[vertices[i]] = static_cast<int>(i);
  }
  add_elements(first, surface, place, local, objects_);
  const Value* written = loaded.root.find("objects");
  for (size_t k = 0; k < objects_.size(); ++k)
    if (const Value* shape = written->items[numbers_[k]].find("shape")) {
      objects_[k].file_unit = unit_of_file(*shape);
      if (std::string note = take_source_faces(*shape, objects_[k]); !note.empty()) notes_.push_back(std::move(note));
    }
}

void RunShapes::choose_times(const ShapeSelection& selection) {
  const std::vector<PvdFile::Frame>& frames = frames_.list();
  if (selection.from && selection.to && *selection.from > *selection.to)
    throw InputError(fmt::format("from: {:.6g} s is after to: {:.6g} s", *selection.from, *selection.to));
  const double first = selection.from.value_or(frames.front().time), last = selection.to.value_or(frames.back().time);
  if (!fps_) {
    for (const PvdFile::Frame& frame : frames)
      if (frame.time >= first * (1 - time_tolerance) && frame.time <= last * (1 + time_tolerance)) times_.push_back(frame.time);
  } else {
    const double begin = std::max(first, frames.front().time), end = std::min(last, frames.back().time);
    for (int i = 0; begin + i / *fps_ <= end + time_tolerance / *fps_; ++i) times_.push_back(std::min(begin + i / *fps_, end));
  }
  if (times_.empty())
    throw InputError(fmt::format("{}: has no frame from {:.6g} to {:.6g} s; its frames are from {:.6g} to {:.6g} s", folder().string(), first, last,
                                 frames.front().time, frames.back().time));
}

double RunShapes::rate() const {
  if (fps_) return *fps_;
  return times_.size() > 1 && times_.back() > times_.front() ? static_cast<double>(times_.size() - 1) / (times_.back() - times_.front()) : rate_of_one_frame;
}

// Elements of the last frame and its outer vertices: most frames have the same.
struct RunShapes::KnownMesh {
  Mesh mesh;  // without vertices
  std::vector<std::vector<int>> outer;

  bool has_elements_of(const Mesh& other) const {
    return !outer.empty() && mesh.tets == other.tets && mesh.triangles == other.triangles && mesh.edges == other.edges && mesh.points == other.points;
  }
};

RunShapes::Loaded RunShapes::load(int number, KnownMesh& known) const {
  FrameFile frame = frames_.read(number);
  if (!known.has_elements_of(frame.mesh)) {
    known.outer = outer_vertices(frame, extract_surface(frame.mesh), numbers_.empty() ? 0 : numbers_.back() + 1);
    std::vector<Vec3> vertices = std::move(frame.mesh.vertices);
    known.mesh = std::move(frame.mesh);
    frame.mesh.vertices = std::move(vertices);
  }
  Loaded loaded{number, {}};
  for (size_t k = 0; k < objects_.size(); ++k) {
    const std::vector<int>& vertices = known.outer[numbers_[k]];
    if (static_cast<int>(vertices.size()) != objects_[k].vertices)
      throw InputError(fmt::format("{}: object '{}' has {} outer vertices, and {} in the first frame; run the scene again", frames_.path_of(number).string(), objects_[k].name,
                                   vertices.size(), objects_[k].vertices));
    loaded.positions.push_back(picked(frame.mesh.vertices, vertices));
  }
  return loaded;
}

void RunShapes::visit(const std::function<void(int, const ObjectPositions&)>& visit) const {
  const std::vector<PvdFile::Frame>& frames = frames_.list();
  Loaded before, after;
  KnownMesh known;
  int next = 0;  // first frame that is not before the sample
  for (size_t i = 0; i < times_.size(); ++i) {
    while (next + 1 < static_cast<int>(frames.size()) && frames[next].time < times_[i]) ++next;
    if (after.frame != next) {
      if (after.frame == next - 1) before = std::move(after);
      after = load(next, known);
    }
    const double end = frames[next].time, begin = next > 0 ? frames[next - 1].time : end;
    if (!(times_[i] < end) || next == 0) {
      visit(static_cast<int>(i), after.positions);
      continue;
    }
    if (before.frame != next - 1) before = load(next - 1, known);
    const double weight = (times_[i] - begin) / (end - begin);
    ObjectPositions between = before.positions;
    for (size_t k = 0; k < between.size(); ++k)
      for (size_t v = 0; v < between[k].size(); ++v) between[k][v] += weight * (after.positions[k][v] - between[k][v]);
    visit(static_cast<int>(i), between);
  }
}

}  // namespace tack
