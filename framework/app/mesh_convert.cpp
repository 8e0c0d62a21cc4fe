// tack mesh convert: writes a mesh file in another format or unit.
#include <fmt/format.h>

#include <cstdio>

#include "framework/app/commands.hpp"
#include "framework/app/mesh_report.hpp"
#include "framework/config/bind.hpp"
#include "framework/config/parse.hpp"
#include "framework/shapes/length_unit.hpp"
#include "geometry/errors.hpp"
#include "geometry/io/mesh_io.hpp"
#include "geometry/io/write_mesh.hpp"
#include "geometry/mesh/triangle_surface.hpp"

namespace tack {
namespace {

struct Conversion {
  LengthUnits units;
  bool surface = false;

  void fields(Fields& f) {
    f.text("from", units.from, "unit that its numbers are in");
    f.text("to", units.to, "unit that they are written in");
    f.flag("surface", surface, "the triangles of its surface alone, as most formats cannot hold tets");
    f.check("from", [this] { return units.problem(); });
  }
};

}  // namespace

int mesh_convert(const std::string& path, const std::vector<std::string>& settings, const MeshOptions& o) {
  Value value = Value::map();
  value.mark.file = std::make_shared<const std::string>("tack mesh convert");
  for (const std::string& setting : settings) apply_override(value, setting);
  Conversion c;
  bind(value, c, "tack mesh convert");
  Mesh mesh = read_mesh(path);
  std::vector<std::string> notes;
  if (c.surface) {
    const std::size_t tets = mesh.tets.size();
    mesh = triangle_surface(mesh, path);
    if (tets > 0) notes.push_back(fmt::format("the surface of {} tets", tets));
  }
  if (!c.units.trivial()) {
    scale(mesh, Vec3::Constant(c.units.factor()));
    notes.push_back(scaled_note(mesh, c.units.factor(), c.units.to));
  }
  if (!mesh.tags.empty()) notes.push_back(fmt::format("{} groups are not written", mesh.tags.size()));
  write_mesh(o.output, mesh);
  fmt::print("{}\n  vertices {}, tets {}, triangles {}, edges {}, points {}\n", o.output, mesh.vertices.size(), mesh.tets.size(), mesh.triangles.size(),
             mesh.edges.size(), mesh.points.size());
  print_lines(notes);
  return exit_done;
}

}  // namespace tack
