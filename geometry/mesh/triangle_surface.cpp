#include "geometry/mesh/triangle_surface.hpp"

#include <fmt/format.h>

#include <cmath>

#include "geometry/errors.hpp"
#include "geometry/mesh/quality.hpp"
#include "geometry/mesh/surface.hpp"

namespace tack {

Mesh triangle_surface(const Mesh& mesh, const std::string& name) {
  if (!mesh.edges.empty() || !mesh.points.empty())
    throw InputError(fmt::format("{}: has {} edges and {} points of their own, which are no surface; give a mesh of triangles or "
                                 "tets", name, mesh.edges.size(), mesh.points.size()));
  if (const std::vector<int> inverted = inverted_tets(mesh); !inverted.empty())
    throw InputError(fmt::format("{}: {} tets are inverted or flat, the first is number {}; give the surface alone", name,
                                 inverted.size(), inverted[0]));
  Mesh surface;
  surface.triangles = mesh.tets.empty() ? mesh.triangles : extract_surface(mesh).triangles;
  if (surface.triangles.empty())
    throw InputError(name + ": has no triangle and no tet; give a mesh of triangles or tets");
  std::vector<int> number(mesh.vertices.size(), -1);
  for (const Triangle& t : surface.triangles)
    for (const int v : t) number[v] = 0;
  for (std::size_t v = 0; v < number.size(); ++v) {
    if (number[v] < 0) continue;
    number[v] = static_cast<int>(surface.vertices.size());
    surface.vertices.push_back(mesh.vertices[v]);
  }
  for (Triangle& t : surface.triangles)
    for (int& v : t) v = number[v];
  return surface;
}

double enclosed_volume_of(const Mesh& surface) {
  // Relative to a corner, so that round-off scales with its size and not with its distance to the origin.
  const Vec3& origin = surface.vertices[surface.triangles[0][0]];
  double volume = 0;
  for (const auto& [a, b, c] : surface.triangles)
    volume += tet_volume(origin, surface.vertices[a], surface.vertices[b], surface.vertices[c]);
  return volume;
}

std::vector<int> components_by_vertices(const Mesh& surface) {
  std::vector<int> root(surface.vertices.size());
  for (size_t v = 0; v < root.size(); ++v) root[v] = static_cast<int>(v);
  const auto find = [&](int v) {
    while (root[v] != v) v = root[v] = root[root[v]];
    return v;
  };
  for (const auto& [a, b, c] : surface.triangles) {
    root[find(b)] = find(a);
    root[find(c)] = find(a);
  }
  std::vector<int> number(surface.vertices.size(), -1), component;
  int parts = 0;
  for (const Triangle& t : surface.triangles) {
    int& n = number[find(t[0])];
    if (n < 0) n = parts++;
    component.push_back(n);
  }
  return component;
}

namespace {

// Returns a remedy that names the size of the mesh, which shows a wrong unit.
std::string remedy_of_size(const Mesh& mesh) {
  return fmt::format("ask for longer edges; or, if the mesh, which is {:.4g} m large, was made in other units, such as millimetres, scale it first "
                     "(place: {{scale: [0.001, 0.001, 0.001]}}; `tack mesh scale FILE factor=0.001 -o FILE`)", bounding_box(mesh).diagonal().norm());
}

}  // namespace

void refuse_too_many_triangles(double expected, const std::string& name, const std::string& remedy) {
  if (!(expected <= 1e7))
    throw InputError(fmt::format("{}: that would make {:.2g} triangles, more than the 1e7 that are sensible; {}", name, expected,
                                 remedy));
}

void refuse_too_short_edges(const Mesh& surface, double edge_length, const std::string& name) {
  const double equilateral = std::sqrt(3.0) / 4 * edge_length * edge_length;
  refuse_too_many_triangles(total_area(surface) / equilateral, name, remedy_of_size(surface));
}

}  // namespace tack
