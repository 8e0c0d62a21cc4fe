// Time series of a run's frames for a page: outer faces of tetrahedra, sheets, edges and points,
// with all arrays of the frames; vectors by their magnitude.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "geometry/io/frame_file.hpp"
#include "geometry/spaced_indices.hpp"
#include "geometry/types.hpp"

namespace tack {

struct FrameSeries {
  struct Field {
    std::string name, unit;
    bool magnitude = false;  // magnitude of a vector
    // Values per vertex; false: per element (triangles, then edges, then points).
    bool of_vertices = true;
    std::vector<std::vector<float>> frames;  // one per frame
  };

  std::vector<double> times;                  // s
  std::vector<int> triangles, edges, points;  // vertex indices, three, two and one per element
  std::vector<int> object;                    // per element: triangles, then edges, then points
  Vec3 origin = Vec3::Zero();                 // origin of positions [m]
  // Per frame: x of all vertices, y of all, z of all [m].
  std::vector<std::vector<float>> positions;
  std::vector<Field> fields;

  int written = 0;                 // frames written by the run; the series may keep fewer
  std::vector<std::string> notes;  // reports of omissions

  int shown = 0;  // number of vertices

  int vertices() const { return shown; }
  int elements() const { return static_cast<int>(object.size()); }
};

// Builds a series frame by frame. Remeshed objects keep their outer faces.
class FrameSeriesBuilder {
 public:
  // Takes the elements of the first frame, without adding the frame to the series.
  explicit FrameSeriesBuilder(const FrameFile& first);
  // Adds a frame. Throws InputError, with nothing added, if its outer faces or fields differ.
  void add(double time, const FrameFile& now);

  FrameSeries& series() { return series_; }
  const FrameSeries& series() const { return series_; }
  // Vertices of the last frame added, in the order of the series.
  const std::vector<int>& kept() const { return kept_; }

 private:
  void adopt_mesh(const FrameFile& now);
  std::vector<float> values_of(const FrameSeries::Field& field,
                               const std::vector<FrameArray>& arrays) const;

  FrameSeries series_;
  Mesh mesh_;
  std::vector<int> kept_;
  std::vector<int> cells_;  // cells of the elements
  // Per object: outer vertices of the mesh that kept_ refers to.
  std::vector<std::vector<int>> outer_;
};

// Reads at most `frames` of the frames in run.pvd, with the first and the last. 0: 200, or fewer if
// a page would get too large. An unreadable frame ends the series, with a note.
FrameSeries read_frames(const std::filesystem::path& run, int frames);

}  // namespace tack
