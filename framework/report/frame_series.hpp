// What a page shows of a run's frames: the outer faces of tets, sheets, edges and points, and every array of the frames on
// them, vectors by their magnitude.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

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

  int vertices() const { return positions.empty() ? 0 : static_cast<int>(positions[0].size() / 3); }
  int elements() const { return static_cast<int>(object.size()); }
};

// At most `frames` of those that run.pvd lists, the first and the last among them; 0: 200, or fewer of a run with more numbers
// than a page should carry. A frame that cannot be read ends the series, with a note.
FrameSeries read_frames(const std::filesystem::path& run, int frames);

}  // namespace tack
