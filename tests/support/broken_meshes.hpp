// Closed surfaces with one defect each.
#pragma once

#include <algorithm>
#include <vector>

#include "geometry/mesh/mesh.hpp"
#include "geometry/shapes/surfaces.hpp"

namespace tack {

inline Mesh boxes_at(const std::vector<Vec3>& places, const Vec3& size = Vec3::Ones()) {
  Mesh mesh;
  for (const Vec3& place : places) {
    Mesh box = box_surface(size);
    translate(box, place);
    append(mesh, box);
  }
  return mesh;
}

inline Mesh with_hole() {
  Mesh mesh = box_surface({1, 1, 1}, {3, 3, 3});
  mesh.triangles.erase(mesh.triangles.begin() + 7);
  return mesh;
}

inline Mesh with_two_holes() {
  Mesh mesh = sphere_surface(1, 4);
  mesh.triangles.erase(mesh.triangles.begin() + 100);
  mesh.triangles.erase(mesh.triangles.begin());
  return mesh;
}

inline Mesh with_flipped() {
  Mesh mesh = box_surface({1, 1, 1}, {2, 2, 2});
  for (const int t : {3, 17}) std::swap(mesh.triangles[t][0], mesh.triangles[t][1]);
  return mesh;
}

inline Mesh inside_out() {
  Mesh mesh = box_surface({1, 1, 1});
  for (Triangle& t : mesh.triangles) std::swap(t[0], t[1]);
  return mesh;
}

inline Mesh with_duplicates() {
  Mesh mesh = box_surface({1, 1, 1});
  mesh.triangles.push_back(mesh.triangles[4]);
  mesh.triangles.push_back({mesh.triangles[2][1], mesh.triangles[2][0], mesh.triangles[2][2]});
  return mesh;
}

// Every triangle with vertices of its own, as in an .stl file.
inline Mesh unmerged() {
  const Mesh box = box_surface({1, 1, 1});
  Mesh mesh;
  for (const Triangle& t : box.triangles) {
    const int n = static_cast<int>(mesh.vertices.size());
    for (const int v : t) mesh.vertices.push_back(box.vertices[v]);
    mesh.triangles.push_back({n, n + 1, n + 2});
  }
  return mesh;
}

// A triangle without area in the place of an edge: the middle of one side of a box is a vertex on
// the other side only.
inline Mesh with_degenerate() {
  Mesh mesh = box_surface({1, 1, 1});
  const auto [a, b, c] = mesh.triangles[0];
  const int m = static_cast<int>(mesh.vertices.size());
  mesh.vertices.push_back((mesh.vertices[a] + mesh.vertices[b]) / 2);
  mesh.triangles[0] = {a, m, c};
  mesh.triangles.push_back({m, b, c});
  mesh.triangles.push_back({a, b, m});
  return mesh;
}

inline Mesh with_collapsed() {
  Mesh mesh = box_surface({1, 1, 1});
  mesh.triangles.push_back({0, 0, 1});
  return mesh;
}

// A fin on an edge, which then has three triangles.
inline Mesh with_fin() {
  Mesh mesh = box_surface({1, 1, 1});
  const auto [a, b, c] = mesh.triangles[0];
  mesh.vertices.push_back(Vec3(3, 3, 3));
  mesh.triangles.push_back({a, b, static_cast<int>(mesh.vertices.size()) - 1});
  return mesh;
}

// Two boxes that share an edge: four triangles at it.
inline Mesh sharing_an_edge() {
  Mesh mesh = boxes_at({Vec3(0, 0, 0), Vec3(1, 1, 0)});
  std::vector<int> same(mesh.vertices.size());
  for (std::size_t v = 0; v < same.size(); ++v)
    same[v] =
        static_cast<int>(std::find(mesh.vertices.begin(), mesh.vertices.end(), mesh.vertices[v]) -
                         mesh.vertices.begin());
  for (Triangle& t : mesh.triangles)
    for (int& v : t) v = same[v];
  return mesh;
}

inline Mesh sharing_a_vertex() {
  Mesh mesh = boxes_at({Vec3(0, 0, 0), Vec3(1, 1, 1)});
  const auto first = std::find(mesh.vertices.begin(), mesh.vertices.end(), Vec3(0.5, 0.5, 0.5));
  const auto second = std::find(first + 1, mesh.vertices.end(), Vec3(0.5, 0.5, 0.5));
  for (Triangle& t : mesh.triangles)
    for (int& v : t)
      if (v == second - mesh.vertices.begin()) v = static_cast<int>(first - mesh.vertices.begin());
  return mesh;
}

inline Mesh crossing_boxes() { return boxes_at({Vec3(0, 0, 0), Vec3(0.5, 0.4, 0.3)}); }

// One part of a ball pushed through the other side.
inline Mesh crossing_itself() {
  Mesh mesh = sphere_surface(1, 4);
  const auto top = std::max_element(mesh.vertices.begin(), mesh.vertices.end(),
                                    [](const Vec3& a, const Vec3& b) { return a.y() < b.y(); });
  top->y() = -1.5;
  return mesh;
}

}  // namespace tack
