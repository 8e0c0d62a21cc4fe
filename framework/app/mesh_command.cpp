// tack mesh info: what a mesh file holds.
#include <fmt/format.h>

#include <cstdio>

#include "framework/app/commands.hpp"
#include "geometry/io/mesh_io.hpp"
#include "geometry/mesh/quality.hpp"
#include "geometry/mesh/surface.hpp"

namespace tack {
namespace {

void print_info(const std::string& path) {
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
}

}  // namespace

void add_mesh_command(CLI::App& app, int& exit_code) {
  auto path = std::make_shared<std::string>();
  CLI::App* mesh = app.add_subcommand("mesh", "Look at mesh files");
  mesh->require_subcommand(1);
  CLI::App* info = mesh->add_subcommand("info", "Print what a mesh file holds");
  info->add_option("file", *path, "obj, msh, ply, stl, off, vtk or vtu")->required();
  info->callback([path, &exit_code] {
    print_info(*path);
    exit_code = exit_done;
  });
}

}  // namespace tack
