// tack mesh info: contents and quality of a mesh file. tack mesh NAME: an operation on it. See
// mesh_convert.cpp for convert, mesh_sdf.cpp for sdf.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "framework/app/commands.hpp"
#include "framework/app/mesh_report.hpp"
#include "framework/config/bind.hpp"
#include "framework/config/nearest.hpp"
#include "framework/config/parse.hpp"
#include "framework/meshing/mesh_operation.hpp"
#include "geometry/errors.hpp"
#include "geometry/io/mesh_io.hpp"
#include "geometry/io/write_mesh.hpp"
#include "geometry/mesh/quality.hpp"
#include "geometry/mesh/surface.hpp"
#include "geometry/meshing/defects.hpp"
#include "geometry/meshing_library.hpp"
#include "geometry/mesh/mesh_quality.hpp"
#include "geometry/mesh/triangle_surface.hpp"

namespace tack {
namespace {

const char* yes_or_no(bool yes) { return yes ? "yes" : "no"; }

void print_defects(const Mesh& surface) {
  const SurfaceDefects d = find_defects(surface);
  fmt::print("  manifold {}, closed {}, crosses itself {}; parts {}, holes {}\n", yes_or_no(d.manifold()), yes_or_no(d.closed()),
             yes_or_no(!d.crossings.empty()), d.component_count, d.holes);
  if (d.volume != 0) fmt::print("  encloses {:.10g} m^3\n", d.volume);
  if (!d.doubled_vertices.empty())
    fmt::print("  {} vertices where another one is, the first {} at {}\n", d.doubled_vertices.size(), d.doubled_vertices[0][1],
               d.doubled_vertices[0][0]);
  print_lines(list_defects(d));
}

int print_info(const std::string& path) {
  const Mesh mesh = read_mesh(path);
  print_contents(path, mesh);
  const Surface surface = extract_surface(mesh);
  if (!surface.triangles.empty() && inverted_tets(mesh).empty()) {
    Mesh triangles;
    triangles.vertices = mesh.vertices;
    triangles.triangles = surface.triangles;
    print_defects(triangles);
  }
  print_lines(quality_notes(mesh));
  return exit_done;
}

// Arguments, separated into files (without '=') and settings.
struct Words {
  std::vector<std::string> files, settings;
  explicit Words(const std::vector<std::string>& words) {
    for (const std::string& word : words) (word.find('=') == word.npos ? files : settings).push_back(word);
  }
};

std::unique_ptr<MeshOperation> operation_of(const std::string& name, const Words& words) {
  Value value = Value::map();
  value.mark.file = std::make_shared<const std::string>("tack mesh " + name);
  value.set("type", Value::scalar(name));
  if (words.files.size() > 1) {
    Value file = Value::map();
    file.set("type", Value::scalar("file"));
    file.set("path", Value::scalar(words.files[1]));
    value.set("with", std::move(file));
  }
  for (const std::string& setting : words.settings) apply_override(value, setting);
  return bind_component<MeshOperation>(value);
}

// Throws InputError with the nearest name unless there is such an operation.
void check_operation(const std::string& name) {
  std::vector<std::string> names = Registry<MeshOperation>::kind().names();
  if (std::find(names.begin(), names.end(), name) != names.end()) return;
  names.insert(names.end(), {"convert", "info", "sdf"});
  std::sort(names.begin(), names.end());
  throw InputError(fmt::format("tack mesh: unknown operation '{}'{}", name, suggestion(name, names, "operations")));
}

}  // namespace

int mesh_command(const MeshOptions& o) {
  const Words words(o.words);
  const bool sdf = o.operation == "sdf", info = o.operation == "info", convert = o.operation == "convert";
  if (!info && !sdf && !convert) check_operation(o.operation);
  if (words.files.empty())
    throw InputError(fmt::format("tack mesh {}: which {}? Give a file", o.operation, sdf ? "level set" : "mesh"));
  if (info) {
    if (words.files.size() > 1 || !words.settings.empty() || !o.output.empty())
      throw InputError("tack mesh info: takes one file and nothing else");
    open_meshing_library();  // before anything is printed
    return print_info(words.files[0]);
  }
  if (!sdf && !o.object.empty()) throw InputError(fmt::format("tack mesh {}: --object is for sdf only", o.operation));
  if (words.files.size() > (sdf || convert ? 1 : 2))
    throw InputError(fmt::format("tack mesh {}: at most {} of use", o.operation, sdf || convert ? "one file is" : "two files are"));
  if (o.output.empty()) throw InputError(fmt::format("tack mesh {}: where to? Give -o FILE", o.operation));
  if (sdf) return mesh_sdf(words.files[0], words.settings, o);
  if (convert) return mesh_convert(words.files[0], words.settings, o);
  const auto operation = operation_of(o.operation, words);
  const Mesh mesh = read_mesh(words.files[0]);
  Notes notes;
  const Mesh result = run_operation(*operation, mesh, words.files[0], notes);
  write_mesh(o.output, result);
  fmt::print("{}\n", o.output);
  print_lines(notes);
  return exit_done;
}

}  // namespace tack
