// What a page shows of a run's frames: the outer faces of tets, sheets, edges and points, and every array of the frames on
// them, vectors by their magnitude.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "geometry/io/frame_file.hpp"
#include "geometry/types.hpp"

namespace tack {

struct FrameSeries {
  struct Field {
    std::string name, unit;
    bool magnitude = false;                  // of a vector
    bool of_vertices = true;                 // or of elements: triangles, then edges, then points
    std::vector<std::vector<float>> frames;  // one per frame
  };

  std::vector<double> times;  // s
  std::vector<int> triangles, edges, points;  // numbers of vertices, three, two and one per element
  std::vector<int> object;                    // of each triangle, then edge, then point
  Vec3 origin = Vec3::Zero();                 // what positions are relative to [m]
  std::vector<std::vector<float>> positions;  // per frame: x of all vertices, y of all, z of all [m]
  std::vector<Field> fields;

  int written = 0;             // frames that the run wrote; fewer are kept
  std::vector<std::string> notes;  // about what is left out

  int shown = 0;               // vertices

  int vertices() const { return shown; }
  int elements() const { return static_cast<int>(object.size()); }
};

// A series that grows frame by frame. Objects that are meshed anew inside have the same outer faces in all of them.
class FrameFollower {
 public:
  // What is shown is that of the first frame, which is not in the series yet.
  explicit FrameFollower(const FrameFile& first);
  // Throws InputError, and adds nothing, if its outer faces or its fields are others.
  void add(double time, const FrameFile& now);

  FrameSeries& series() { return series_; }
  const FrameSeries& series() const { return series_; }
  // Of the frame that was added last: the vertices that are shown, in the order of the series.
  const std::vector<int>& kept() const { return kept_; }

 private:
  void follow(const FrameFile& now);
  std::vector<float> values_of(const FrameSeries::Field& field, const std::vector<FrameArray>& arrays) const;

  FrameSeries series_;
  Mesh mesh_;
  std::vector<int> kept_;
  std::vector<int> cells_;  // of elements
  std::vector<std::vector<int>> outer_;  // by object, of the mesh that kept_ counts in
};

// So many of a number of things, evenly spread, both ends among them; one: the last.
std::vector<int> evenly(int count, int wanted);

// At most `frames` of those that run.pvd lists, the first and the last among them; 0: 200, or fewer of a run with more numbers
// than a page should carry. A frame that cannot be read ends the series, with a note.
FrameSeries read_frames(const std::filesystem::path& run, int frames);

}  // namespace tack
