#include "framework/output/outer_vertices.hpp"

#include <algorithm>

namespace tack {

std::vector<int> objects_of_vertices(const FrameFile& frame) {
  const auto array = std::find_if(frame.cell_arrays.begin(), frame.cell_arrays.end(), [](const FrameArray& a) { return a.name == "object"; });
  std::vector<int> object(frame.mesh.vertices.size(), -1);
  int cell = 0;
  const auto number = [&] { return array == frame.cell_arrays.end() ? 0 : static_cast<int>(array->values(cell)); };
  const auto note = [&](const auto& elements) {
    for (const auto& element : elements) {
      for (const int v : element) object[v] = number();
      ++cell;
    }
  };
  note(frame.mesh.tets);
  note(frame.mesh.triangles);
  note(frame.mesh.edges);
  for (const int v : frame.mesh.points) {
    object[v] = number();
    ++cell;
  }
  return object;
}

std::vector<std::vector<int>> outer_vertices(const FrameFile& frame, const Surface& surface, int count) {
  const std::vector<int> object = objects_of_vertices(frame);
  for (const int o : object) count = std::max(count, o + 1);
  std::vector<std::vector<int>> outer(count);
  std::vector<char> is_outer(object.size(), 0);
  for (const int v : surface.vertices) is_outer[v] = 1;
  for (const int v : frame.mesh.points) is_outer[v] = 1;  // also of tetrahedra
  for (size_t v = 0; v < object.size(); ++v)
    if (is_outer[v] && object[v] >= 0) outer[object[v]].push_back(static_cast<int>(v));
  return outer;
}

}  // namespace tack
