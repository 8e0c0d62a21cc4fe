// tack mesh info: what a mesh file holds.
#include <fmt/format.h>

#include <cstdio>

#include "framework/app/commands.hpp"
#include "geometry/io/mesh_io.hpp"
#include "geometry/mesh/quality.hpp"
#include "geometry/mesh/surface.hpp"

namespace tack {

int mesh_info_command(const std::string& path) {
  const Mesh mesh = read_mesh(path);
  const Surface surface = extract_surface(mesh);
  const auto box = bounding_box(mesh);
  fmt::print("{}\n  vertices {}, tets {}, triangles {}, edges {}, points {}\n", path, mesh.vertices.size(),
             mesh.tets.size(), mesh.triangles.size(), mesh.edges.size(), mesh.points.size());
  if (!box.isEmpty())
    fmt::print("  from ({}, {}, {}) to ({}, {}, {}) m\n", box.min().x(), box.min().y(), box.min().z(),
               box.max().x(), box.max().y(), box.max().z());
  fmt::print("  surface: {} vertices, {} edges, {} triangles\n", surface.vertices.size(),
             surface.edges.size(), surface.triangles.size());
  if (!mesh.tets.empty())
    fmt::print("  volume {} m^3, inverted tets {}\n", total_volume(mesh), inverted_tets(mesh).size());
  for (const auto& [name, vertices] : mesh.tags) fmt::print("  group '{}': {} vertices\n", name, vertices.size());
  return exit_done;
}

}  // namespace tack
