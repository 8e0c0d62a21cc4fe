#include "framework/app/mesh_report.hpp"

#include <fmt/format.h>

#include <cstdio>

#include "geometry/mesh/quality.hpp"
#include "geometry/mesh/surface.hpp"

namespace tack {

void print_lines(const std::vector<std::string>& lines) {
  for (const std::string& line : lines) fmt::print("  {}\n", line);
}

void print_contents(const std::string& title, const Mesh& mesh) {
  fmt::print("{}\n  vertices {}, tets {}, triangles {}, edges {}, points {}\n", title, mesh.vertices.size(), mesh.tets.size(),
             mesh.triangles.size(), mesh.edges.size(), mesh.points.size());
  if (const auto box = bounding_box(mesh); !box.isEmpty())
    fmt::print("  from ({}, {}, {}) to ({}, {}, {}) m\n", box.min().x(), box.min().y(), box.min().z(), box.max().x(), box.max().y(),
               box.max().z());
  const std::vector<int> inverted = inverted_tets(mesh);
  if (!mesh.tets.empty()) fmt::print("  volume {} m^3, inverted tets {}\n", total_volume(mesh), inverted.size());
  if (!inverted.empty()) fmt::print("  the first inverted tet is number {}\n", inverted[0]);
  const Surface surface = extract_surface(mesh);
  fmt::print("  surface: {} vertices, {} edges, {} triangles\n", surface.vertices.size(), surface.edges.size(), surface.triangles.size());
  for (const auto& [name, vertices] : mesh.tags) fmt::print("  group '{}': {} vertices\n", name, vertices.size());
}

}  // namespace tack
