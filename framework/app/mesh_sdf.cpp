// tack mesh sdf: the surface of a level set as a mesh file.
#include <fmt/format.h>

#include <chrono>
#include <cstdio>

#include "framework/app/commands.hpp"
#include "framework/app/mesh_report.hpp"
#include "framework/config/bind.hpp"
#include "framework/config/parse.hpp"
#include "framework/level_set/level_set_shape.hpp"
#include "framework/shapes/mesh_cache.hpp"
#include "geometry/errors.hpp"
#include "geometry/io/write_mesh.hpp"
#include "geometry/mesh/mass_properties.hpp"
#include "geometry/mesh/mesh_quality.hpp"
#include "geometry/mesh/oriented_surface.hpp"

namespace tack {
namespace {

struct PlacedShape {
  std::unique_ptr<ShapeSource> shape;
  MeshPlacement place;
};

// A level set file: the keys of the shape and its placement.
struct LevelSetFile {
  LevelSetShape& shape;
  MeshPlacement& place;
  void fields(Fields& f) {
    shape.fields(f);
    f.object("place", place, "where the surface is put");
  }
};

std::string name_of(const Value& object) {
  const Value* name = object.find("name");
  return name ? name->text : "";
}

PlacedShape of_object(const Value& scene, const std::string& name, const std::string& path) {
  const Value* objects = scene.find("objects");
  if (!objects) throw InputError(fmt::format("{}: has no `objects`; without --object, it is the file of a level set", path));
  std::string names;
  for (const Value& object : objects->items) {
    names += (names.empty() ? "" : ", ") + name_of(object);
    if (name_of(object) != name) continue;
    const Value* shape = object.find("shape");
    if (!shape) throw InputError(fmt::format("{}: object '{}' has no `shape`", object.mark.text(), name));
    PlacedShape placed{bind_component<ShapeSource>(*shape), {}};
    if (const Value* place = object.find("place")) bind(*place, placed.place, "place");
    return placed;
  }
  throw InputError(fmt::format("{}: no object '{}'; there are: {}", path, name, names));
}

PlacedShape of_file(const Value& root, const std::string& path) {
  if (root.find("objects")) throw InputError(path + ": is an experiment; say which of its objects with --object NAME");
  auto shape = std::make_unique<LevelSetShape>();
  PlacedShape placed;
  LevelSetFile file{*shape, placed.place};
  bind(root, file, "the file of a level set");
  placed.shape = std::move(shape);
  return placed;
}

// Returns true for the surface of a solid; sheets, rods and particles enclose no volume.
bool closed(const Mesh& mesh) { return !mesh.triangles.empty() && OrientedSurface(consistently_oriented(mesh.triangles)).closed(); }

}  // namespace

int mesh_sdf(const std::string& path, const std::vector<std::string>& settings, const MeshOptions& o) {
  const auto start = std::chrono::steady_clock::now();
  Value root = parse_file(path);
  for (const std::string& setting : settings) apply_override(root, setting);
  const PlacedShape placed = o.object.empty() ? of_file(root, path) : of_object(root, o.object, path);
  const auto kept = mesh_of_shape(*placed.shape);
  Mesh mesh = kept->mesh;
  placed.place.apply(mesh);
  write_mesh(o.output, mesh);
  print_contents(o.output, mesh);
  if (mesh.tets.empty() && closed(mesh)) fmt::print("  encloses {:.10g} m^3\n", mass_properties(mesh).volume);
  print_lines(kept->notes);
  print_lines(quality_notes(mesh));
  print_lines({fmt::format("took {:.2g} s", std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count())});
  return exit_done;
}

}  // namespace tack
