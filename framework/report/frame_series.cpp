#include "framework/report/frame_series.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "framework/output/outer_vertices.hpp"
#include "framework/output/pvd.hpp"
#include "geometry/errors.hpp"
#include "geometry/mesh/surface.hpp"

namespace tack {
namespace {

namespace fs = std::filesystem;

constexpr int frame_count_default = 200;
constexpr double page_numbers_max = 16e6;  // limit per page: some 15 MB

using Face = std::array<int, 3>;

// Returns the cell of a face: the first of its tetrahedra, else the triangle itself; -1: none.
class FaceOwners {
 public:
  explicit FaceOwners(const Mesh& mesh) {
    int cell = 0;
    for (const Tet& t : mesh.tets) {
      for (int left_out = 0; left_out < 4; ++left_out) add(t[(left_out + 1) % 4], t[(left_out + 2) % 4], t[(left_out + 3) % 4], cell);
      ++cell;
    }
    for (const Triangle& t : mesh.triangles) add(t[0], t[1], t[2], cell++);
    std::sort(owners_.begin(), owners_.end());
  }
  int of(const Triangle& t) const {
    const Face face = sorted(t[0], t[1], t[2]);
    const auto found = std::lower_bound(owners_.begin(), owners_.end(), std::pair(face, 0));
    return found != owners_.end() && found->first == face ? found->second : -1;
  }

 private:
  static Face sorted(int a, int b, int c) {
    Face face{a, b, c};
    std::sort(face.begin(), face.end());
    return face;
  }
  void add(int a, int b, int c, int cell) { owners_.emplace_back(sorted(a, b, c), cell); }

  std::vector<std::pair<Face, int>> owners_;
};

}  // namespace

FrameSeriesBuilder::FrameSeriesBuilder(const FrameFile& first) {
  mesh_ = first.mesh;
  const Surface surface = extract_surface(mesh_);
  const FaceOwners owners(mesh_);
  std::vector<int> number(mesh_.vertices.size(), -1);
  const auto keep = [&](int v, std::vector<int>& elements) {
    if (number[v] < 0) {
      number[v] = static_cast<int>(kept_.size());
      kept_.push_back(v);
    }
    elements.push_back(number[v]);
  };
  for (const Triangle& t : surface.triangles) {
    for (const int v : t) keep(v, series_.triangles);
    cells_.push_back(owners.of(t));
  }
  int cell = static_cast<int>(mesh_.tets.size() + mesh_.triangles.size());
  for (const Edge& e : mesh_.edges) {
    for (const int v : e) keep(v, series_.edges);
    cells_.push_back(cell++);
  }
  for (const int v : mesh_.points) {
    keep(v, series_.points);
    cells_.push_back(cell++);
  }
  const auto object = std::find_if(first.cell_arrays.begin(), first.cell_arrays.end(), [](const FrameArray& a) { return a.name == "object"; });
  for (const int c : cells_) series_.object.push_back(object == first.cell_arrays.end() ? 0 : static_cast<int>(object->values(c)));
  series_.origin = bounding_box(mesh_).center();
  series_.shown = static_cast<int>(kept_.size());
  outer_ = outer_vertices(first, surface);
  for (const FrameArray& a : first.vertex_arrays) series_.fields.push_back({a.name, a.unit, a.components > 1, true, {}});
  for (const FrameArray& a : first.cell_arrays)
    if (a.name != "object") series_.fields.push_back({a.name, a.unit, a.components > 1, false, {}});
}

// Updates the indices of kept vertices and cells for a frame with another mesh inside.
void FrameSeriesBuilder::adopt_mesh(const FrameFile& now) {
  const auto differs = [] { throw InputError("its mesh differs from that of the first frame"); };
  const Surface surface = extract_surface(now.mesh);
  const auto outer = outer_vertices(now, surface);
  std::vector<int> number(mesh_.vertices.size(), -1);
  if (outer.size() != outer_.size() || surface.triangles.size() != series_.triangles.size() / 3 || now.mesh.triangles.size() != mesh_.triangles.size() ||
      now.mesh.edges.size() != mesh_.edges.size() || now.mesh.points.size() != mesh_.points.size())
    differs();
  for (size_t object = 0; object < outer.size(); ++object) {
    if (outer[object].size() != outer_[object].size()) differs();
    for (size_t i = 0; i < outer[object].size(); ++i) number[outer_[object][i]] = outer[object][i];
  }
  for (int& v : kept_) v = number[v];
  const FaceOwners owners(now.mesh);
  const size_t triangles = series_.triangles.size() / 3;
  for (size_t t = 0; t < triangles; ++t) {
    const Triangle on = {kept_[series_.triangles[3 * t]], kept_[series_.triangles[3 * t + 1]], kept_[series_.triangles[3 * t + 2]]};
    cells_[t] = owners.of(on);
    if (cells_[t] < 0) differs();
  }
  for (size_t c = triangles; c < cells_.size(); ++c) cells_[c] = static_cast<int>(now.mesh.tets.size() + now.mesh.triangles.size() + c - triangles);
  outer_ = outer;
  mesh_ = now.mesh;
}

void FrameSeriesBuilder::add(double time, const FrameFile& now) {
  if (now.mesh.vertices.size() != mesh_.vertices.size() || now.mesh.tets != mesh_.tets || now.mesh.triangles != mesh_.triangles ||
      now.mesh.edges != mesh_.edges || now.mesh.points != mesh_.points)
    adopt_mesh(now);
  const size_t n = kept_.size();
  std::vector<float> x(3 * n);
  for (size_t i = 0; i < n; ++i) {
    const Vec3 position = now.mesh.vertices[kept_[i]] - series_.origin;
    for (int c = 0; c < 3; ++c) x[c * n + i] = static_cast<float>(position(c));
  }
  std::vector<std::vector<float>> values;
  for (const auto& field : series_.fields) values.push_back(values_of(field, field.of_vertices ? now.vertex_arrays : now.cell_arrays));
  series_.times.push_back(time);
  series_.positions.push_back(std::move(x));
  for (size_t f = 0; f < values.size(); ++f) series_.fields[f].frames.push_back(std::move(values[f]));
}

std::vector<float> FrameSeriesBuilder::values_of(const FrameSeries::Field& field, const std::vector<FrameArray>& arrays) const {
  const auto array = std::find_if(arrays.begin(), arrays.end(), [&](const FrameArray& a) { return a.name == field.name; });
  if (array == arrays.end()) throw InputError(fmt::format("it lacks the field '{}' of the first frame", field.name));
  std::vector<float> values;
  for (const int i : field.of_vertices ? kept_ : cells_) {
    const auto entry = array->values.segment(static_cast<Eigen::Index>(array->components) * i, array->components);
    values.push_back(static_cast<float>(array->components > 1 ? entry.norm() : entry(0)));
  }
  return values;
}

namespace {

// Returns the number of frames that keeps a page within its limit.
int affordable_frames(FrameSeries& series, size_t vertices) {
  double numbers = 3.0 * static_cast<double>(series.vertices());
  for (const auto& field : series.fields) numbers += static_cast<double>(field.of_vertices ? series.vertices() : series.elements());
  const int most = std::max(2, static_cast<int>(std::min(1e9, page_numbers_max / numbers)));
  if (most < std::min(frame_count_default, series.written))
    series.notes.push_back(fmt::format("{} of {} frames are kept: with {} vertices, more would make the page too large. `--frames N` "
                                       "sets the number of frames.", most, series.written, vertices));
  return std::min(frame_count_default, most);
}

}  // namespace

FrameSeries read_frames(const fs::path& run, int frames) {
  const auto list = PvdFile::continued(run / "run.pvd", std::numeric_limits<double>::infinity()).list();
  if (list.empty()) return {};
  FrameFile first = read_frame(run / list[0].file);
  FrameSeriesBuilder follower(first);
  FrameSeries& series = follower.series();
  series.written = static_cast<int>(list.size());
  const int wanted = frames > 0 ? frames : affordable_frames(series, first.mesh.vertices.size());
  for (const int i : spaced_indices(static_cast<int>(list.size()), wanted)) {
    try {
      follower.add(list[i].time, i == 0 ? std::move(first) : read_frame(run / list[i].file));
    } catch (const InputError& error) {
      series.notes.push_back(fmt::format("The frames end at {:g} s: {}", list[i].time, error.what()));
      break;
    }
  }
  return std::move(series);
}

}  // namespace tack
