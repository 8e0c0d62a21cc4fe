#include "geometry/meshing/repair.hpp"

#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair_degeneracies.h>
#include <CGAL/Polygon_mesh_processing/repair_self_intersections.h>
#include <CGAL/Polygon_mesh_processing/stitch_borders.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>

#include "geometry/mesh/cleanup.hpp"
#include "geometry/meshing/booleans.hpp"
#include "geometry/meshing/cgal_mesh.hpp"
#include "geometry/meshing/defects.hpp"
#include "geometry/mesh/quality.hpp"
#include "geometry/mesh/triangle_surface.hpp"

namespace tack {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;

constexpr const char* crossing_sheets_remedy = "sheets that cross other surfaces are not cut by repair; move them apart or cut them in a modelling program, or give each of them a "
                                               "thickness there, so that closed parts are united";
constexpr double missing_area_fraction_max = 0.1;  // of the area of a component that counts as a solid

// A mesh, and the indices of its triangles in the input mesh.
struct NumberedMesh {
  Mesh mesh;
  std::vector<int> numbers;

  // Removes the triangles for which drop(index) is true; returns their indices in the input mesh.
  template <class Drop>
  std::vector<int> remove(const Drop& drop) {
    std::vector<int> removed, kept;
    std::vector<Triangle> triangles;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const bool gone = drop(static_cast<int>(t));
      (gone ? removed : kept).push_back(numbers[t]);
      if (!gone) triangles.push_back(mesh.triangles[t]);
    }
    mesh.triangles = std::move(triangles);
    numbers = std::move(kept);
    return removed;
  }
};

std::string first_ten(const std::vector<int>& numbers) {
  const std::size_t count = std::min<std::size_t>(numbers.size(), 10);
  return fmt::format("{}{}", fmt::join(numbers.begin(), numbers.begin() + static_cast<std::ptrdiff_t>(count), ", "),
                     numbers.size() > count ? ", ..." : "");
}

void note_removed(Notes& notes, const std::vector<int>& removed, const char* what) {
  if (!removed.empty()) notes.push_back(fmt::format("removed {} {} triangles: {}", removed.size(), what, first_ten(removed)));
}

// Returns the rounding error of coordinates in single precision: four units in the last place of the largest one, but at most a quarter of the
// shortest edge.
double rounding_of(const Mesh& mesh) {
  constexpr double unit = 1.1920929e-7;  // 2^-23
  double largest = 0, shortest = std::numeric_limits<double>::infinity();
  for (const Vec3& v : mesh.vertices) largest = std::max(largest, v.lpNorm<Eigen::Infinity>());
  for (const Triangle& t : mesh.triangles)
    for (int i = 0; i < 3; ++i)
      if (const double length = (mesh.vertices[t[i]] - mesh.vertices[t[(i + 1) % 3]]).norm(); length > 0) shortest = std::min(shortest, length);
  return std::min(4 * unit * largest, shortest / 4);
}

// Merges each vertex with the first one within the distance.
void merge_vertices(NumberedMesh& s, double distance, Notes& notes) {
  Mesh points;
  points.vertices = s.mesh.vertices;
  for (std::size_t v = 0; v < points.vertices.size(); ++v) {
    points.points.push_back(static_cast<int>(v));
    points.tags[std::to_string(v)] = {static_cast<int>(v)};
  }
  merge_duplicate_vertices(points, distance);
  std::vector<int> merged(s.mesh.vertices.size());
  for (const auto& [old, now] : points.tags) merged[static_cast<std::size_t>(std::stoi(old))] = now[0];
  if (points.vertices.size() == merged.size()) return;
  notes.push_back(fmt::format("merged {} vertices with others at the same position", merged.size() - points.vertices.size()));
  s.mesh.vertices = points.vertices;
  for (Triangle& t : s.mesh.triangles)
    for (int& v : t) v = merged[v];
}

std::vector<int> repeated(const std::vector<std::array<int, 2>>& duplicates) {
  std::vector<int> later;
  for (const auto& [first, second] : duplicates) later.push_back(second);
  std::sort(later.begin(), later.end());
  return later;
}

// Returns the triangles of dangling sheets, which begin at an edge of more than two triangles and end in open edges.
std::vector<int> dangling(const Mesh& mesh, const SurfaceDefects& defects) {
  std::set<Edge> crowded;
  for (const CrowdedEdge& e : defects.crowded_edges) crowded.insert(e.edge);
  std::map<Edge, std::vector<int>> uses;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (int i = 0; i < 3; ++i) {
      const int a = mesh.triangles[t][i], b = mesh.triangles[t][(i + 1) % 3];
      uses[{std::min(a, b), std::max(a, b)}].push_back(static_cast<int>(t));
    }
  std::vector<int> sheet(mesh.triangles.size(), -1);
  int sheets = 0;
  std::vector<char> hangs, ends;
  for (std::size_t start = 0; start < mesh.triangles.size(); ++start) {
    if (sheet[start] >= 0) continue;
    std::vector<int> reached = {static_cast<int>(start)};
    sheet[start] = sheets++;
    hangs.push_back(0), ends.push_back(0);
    for (std::size_t i = 0; i < reached.size(); ++i)
      for (int k = 0; k < 3; ++k) {
        const int a = mesh.triangles[reached[i]][k], b = mesh.triangles[reached[i]][(k + 1) % 3];
        const Edge edge = {std::min(a, b), std::max(a, b)};
        const std::vector<int>& users = uses[edge];
        if (crowded.contains(edge)) {
          hangs.back() = 1;
        } else if (users.size() == 1) {
          ends.back() = 1;
        } else {
          for (const int t : users)
            if (sheet[t] < 0) sheet[t] = sheet[start], reached.push_back(t);
        }
      }
  }
  std::vector<int> found;
  for (std::size_t t = 0; t < sheet.size(); ++t)
    if (hangs[sheet[t]] && ends[sheet[t]]) found.push_back(static_cast<int>(t));
  return found;
}

void clean_triangles(NumberedMesh& s, Notes& notes) {
  const auto in = [](const std::vector<int>& list) {
    return [&list](int t) { return std::binary_search(list.begin(), list.end(), t); };
  };
  note_removed(notes, s.remove([&](int t) {
    const auto& [a, b, c] = s.mesh.triangles[t];
    return a == b || b == c || c == a;
  }), "collapsed");
  note_removed(notes, s.remove(in(repeated(find_defects(s.mesh, false).duplicates))), "duplicated");
  for (;;) {
    const std::vector<int> hanging = dangling(s.mesh, find_defects(s.mesh, false));
    if (hanging.empty() || hanging.size() == s.mesh.triangles.size()) return;
    note_removed(notes, s.remove(in(hanging)), "dangling");
  }
}

// Orients neighbours consistently, and cuts surfaces apart at non-manifold edges and vertices.
CgalMesh oriented(const NumberedMesh& s, Notes& notes) {
  std::vector<CgalPoint> points;
  std::vector<std::vector<std::size_t>> polygons;
  for (const Vec3& v : s.mesh.vertices) points.push_back(cgal_point(v));
  for (const auto& [a, b, c] : s.mesh.triangles)
    polygons.push_back({static_cast<std::size_t>(a), static_cast<std::size_t>(b), static_cast<std::size_t>(c)});
  pmp::orient_polygon_soup(points, polygons);
  std::vector<int> flipped;
  for (std::size_t t = 0; t < polygons.size(); ++t) {
    std::array<Vec3, 3> now;
    for (int i = 0; i < 3; ++i) now[i] = vec3(points[polygons[t][i]]);
    const auto& [a, b, c] = s.mesh.triangles[t];
    const Vec3 normal = (s.mesh.vertices[b] - s.mesh.vertices[a]).cross(s.mesh.vertices[c] - s.mesh.vertices[a]);
    if (normal.dot((now[1] - now[0]).cross(now[2] - now[0])) < 0) flipped.push_back(s.numbers[t]);
  }
  if (!flipped.empty()) notes.push_back(fmt::format("turned {} triangles to face as their neighbours: {}", flipped.size(), first_ten(flipped)));
  if (points.size() > s.mesh.vertices.size())
    notes.push_back(fmt::format("cut surfaces apart that touched, at {} vertices", points.size() - s.mesh.vertices.size()));
  CgalMesh m;
  pmp::polygon_soup_to_polygon_mesh(points, polygons, m);
  pmp::stitch_borders(m, CGAL::parameters::apply_per_connected_component(true));
  return m;
}

std::vector<Mesh> split(const Mesh& mesh) {
  const std::vector<int> component = components_by_vertices(mesh);
  std::vector<Mesh> components(component.empty() ? 0 : static_cast<std::size_t>(*std::max_element(component.begin(), component.end())) + 1);
  for (std::size_t t = 0; t < component.size(); ++t) components[component[t]].triangles.push_back(mesh.triangles[t]);
  for (Mesh& p : components) {
    p.vertices = mesh.vertices;
    drop_unused_vertices(p);
  }
  return components;
}

struct Filled {
  CgalMesh mesh;
  std::size_t holes = 0, triangles = 0;
  double area = 0, added = 0;  // of the component, of the filling of its holes [m^2]
};

Filled filled(CgalMesh m) {
  Filled result;
  result.area = pmp::area(m);
  std::vector<CgalMesh::Halfedge_index> borders;
  pmp::extract_boundary_cycles(m, std::back_inserter(borders));
  std::vector<CgalMesh::Face_index> faces;
  for (const auto h : borders) pmp::triangulate_hole(m, h, std::back_inserter(faces));
  result.holes = borders.size();
  result.triangles = faces.size();
  result.added = pmp::area(faces, m);
  result.mesh = std::move(m);
  return result;
}

// Fills holes of each connected component. Returns the number of holes that stay.
std::size_t fill_holes(CgalMesh& m, Holes how, Notes& notes) {
  if (CGAL::is_closed(m)) return 0;
  Mesh all;
  Filled closed, open;
  for (const Mesh& component : split(from_cgal(m))) {
    const CgalMesh input = to_cgal(component);
    Filled filling = filled(input);
    const bool fill = how == Holes::fill || (how == Holes::of_solids && filling.added <= missing_area_fraction_max * filling.area);
    append(all, from_cgal(fill ? filling.mesh : input));
    Filled& sum = fill ? closed : open;
    sum.holes += filling.holes, sum.triangles += filling.triangles, sum.area += filling.area, sum.added += filling.added;
  }
  m = to_cgal(all);
  const auto percent = [](const Filled& sum) { return 100 * sum.added / sum.area; };
  if (closed.holes > 0)
    notes.push_back(fmt::format("filled {} holes with {} triangles, {:.3g} % of the area", closed.holes, closed.triangles, percent(closed)));
  if (open.holes > 0)
    notes.push_back(fmt::format("left {} holes open, {:.3g} % of the area{}", open.holes, percent(open),
                                how == Holes::keep ? "" : ": taken for borders of a sheet; holes=fill fills them"));
  return open.holes;
}

// Returns the mesh with closed components that cross each other united.
Mesh unite_crossing_components(const Mesh& mesh, Notes& notes) {
  const SurfaceDefects defects = find_defects(mesh);
  const std::vector<int> component = components_by_vertices(mesh);
  std::set<int> crossing;
  for (const auto& [s, t] : defects.crossings)
    if (component[s] != component[t]) crossing.insert(component[s]), crossing.insert(component[t]);
  if (crossing.empty() || defects.crossings.size() >= crossing_count_max) return mesh;
  std::vector<Mesh> components = split(mesh);
  Mesh united, others;
  for (std::size_t p = 0; p < components.size(); ++p) {
    if (!crossing.contains(static_cast<int>(p))) {
      append(others, components[p]);
      continue;
    }
    if (find_defects(components[p], false).inside_out())
      for (Triangle& t : components[p].triangles) std::swap(t[1], t[2]);
    if (!find_defects(components[p]).bounds_volume()) return mesh;  // crosses itself as well
    try {
      Notes ignored;
      united = united.triangles.empty() ? components[p] : boolean(Boolean::unite, united, components[p], "part", "part", ignored);
    } catch (const InputError&) {
      return mesh;  // they touch: the remaining defects are reported
    }
  }
  notes.push_back(fmt::format("united {} closed components that cross each other", crossing.size()));
  append(others, united);
  return others;
}

// Returns true if the triangles of an open component cross those of another component. Which of the pieces to keep there is a decision of the modeller: CGAL's
// repair would cut the sheets and fill the cuts with new triangles.
bool sheets_cross(const Mesh& mesh, const SurfaceDefects& defects) {
  const std::vector<int> component = components_by_vertices(mesh);
  std::set<int> open;
  for (const OpenEdge& e : defects.open_edges) open.insert(component[e.triangle]);
  return std::any_of(defects.crossings.begin(), defects.crossings.end(), [&](const auto& pair) {
    const int a = component[pair[0]], b = component[pair[1]];
    return a != b && (open.contains(a) || open.contains(b));
  });
}

// Replaces triangles of a component that cross each other. Returns the mesh as it was if that fails for a surface with borders: it would have others then.
Mesh without_crossings(const Mesh& mesh, const SurfaceDefects& before, Notes& notes) {
  CgalMesh m = to_cgal(mesh);
  pmp::experimental::remove_self_intersections(m, CGAL::parameters::preserve_genus(false));
  m.collect_garbage();
  Mesh result = from_cgal(m);
  const SurfaceDefects after = find_defects(result);
  const bool same_borders = after.holes == before.holes && after.component_count == before.component_count;
  if (!before.closed() && !(after.crossings.empty() && same_borders)) return mesh;
  if (after.crossings.size() < before.crossings.size())
    notes.push_back(fmt::format("replaced triangles that crossed each other: {} pairs, {} left", before.crossings.size(), after.crossings.size()));
  return result;
}

void orient_outwards(CgalMesh& m, Notes& notes) {
  if (!CGAL::is_closed(m)) return;
  const Mesh before = from_cgal(m);
  pmp::orient_to_bound_a_volume(m);
  const Mesh after = from_cgal(m);
  const std::vector<int> component = components_by_vertices(before);
  std::set<int> flipped;
  for (std::size_t t = 0; t < component.size(); ++t) {
    const auto normal = [&](const Mesh& mesh) -> Vec3 {
      const auto& [a, b, c] = mesh.triangles[t];
      return (mesh.vertices[b] - mesh.vertices[a]).cross(mesh.vertices[c] - mesh.vertices[a]);
    };
    if (normal(before).dot(normal(after)) < 0) flipped.insert(component[t]);
  }
  if (!flipped.empty()) notes.push_back(fmt::format("turned {} components to have their normals outwards (hollows: inwards)", flipped.size()));
}

// Returns lines with the position of the first defect of each kind.
std::string defect_positions(const Mesh& mesh, const SurfaceDefects& d) {
  std::string text;
  const auto add = [&](const char* what, const Vec3& x) { text += fmt::format("\n  {} at ({:.4g}, {:.4g}, {:.4g})", what, x[0], x[1], x[2]); };
  const auto middle = [&](int t) -> Vec3 {
    const auto& [a, b, c] = mesh.triangles[t];
    return (mesh.vertices[a] + mesh.vertices[b] + mesh.vertices[c]) / 3;
  };
  if (!d.degenerate.empty()) add("the first degenerate triangle", middle(d.degenerate[0]));
  if (!d.open_edges.empty()) add("the first open edge", mesh.vertices[d.open_edges[0].edge[0]]);
  if (!d.crowded_edges.empty()) add("the first edge of more than two triangles", mesh.vertices[d.crowded_edges[0].edge[0]]);
  if (!d.pinched_vertices.empty()) add("the first vertex in which surfaces touch", mesh.vertices[d.pinched_vertices[0]]);
  if (!d.crossings.empty()) add("the first crossing", middle(d.crossings[0][0]));
  return text;
}

// Throws InputError for a sheet whose border was filled: it coincides with its filling and encloses nothing.
void refuse_flat_components(const Mesh& mesh, const std::string& name) {
  constexpr double flat = 1e-8;  // volume by area and size
  for (const Mesh& component : split(mesh)) {
    const double size = bounding_box(component).diagonal().norm();
    if (std::abs(enclosed_volume_of(component)) > flat * total_area(component) * size) continue;
    const Vec3& x = component.vertices[component.triangles[0][0]];
    throw InputError(fmt::format("{}: the part at ({:.4g}, {:.4g}, {:.4g}) is an open sheet: closing its border would lay flat triangles on it that enclose "
                                 "nothing; keep it open (holes=keep), as a sheet may be, or give it a thickness in a modelling program", name,
                                 x[0], x[1], x[2]));
  }
}

void refuse(const Mesh& mesh, const SurfaceDefects& before, const SurfaceDefects& after, const Mesh& left, const std::string& name,
            const std::string& remedy) {
  std::string text = name + ": could not be repaired. Given were " + std::to_string(mesh.triangles.size()) + " triangles with";
  for (const std::string& line : list_defects(before)) text += "\n  " + line;
  text += "\nof which is left, in numbers of the repaired mesh,";
  for (const std::string& line : list_defects(after)) text += "\n  " + line;
  throw InputError(text + defect_positions(left, after) + "\nremedy: " + (remedy.empty() ? "repair these positions in a modelling program" : remedy));
}

}  // namespace

Mesh repair(const Mesh& mesh, const RepairOptions& o, const std::string& name, Notes& notes) {
  const Mesh input = triangle_surface(mesh, name);
  const SurfaceDefects before = find_defects(input);
  NumberedMesh surface{input, {}};
  for (std::size_t t = 0; t < input.triangles.size(); ++t) surface.numbers.push_back(static_cast<int>(t));
  for (const std::string& line : list_defects(before)) notes.push_back("found " + line);
  merge_vertices(surface, o.merge.value_or(rounding_of(surface.mesh)), notes);
  clean_triangles(surface, notes);
  if (surface.mesh.triangles.empty()) throw InputError(name + ": no triangle is left that has an area; nothing to repair");
  CgalMesh m = oriented(surface, notes);
  const std::size_t all = m.number_of_faces();
  pmp::remove_degenerate_faces(m);
  m.collect_garbage();
  if (m.number_of_faces() < all) notes.push_back(fmt::format("removed {} triangles without area by collapses and flips", all - m.number_of_faces()));
  const std::size_t kept = fill_holes(m, o.holes, notes);
  Mesh result = from_cgal(m);
  drop_unused_vertices(result);
  if (result.triangles.empty()) throw InputError(name + ": no triangle is left that has an area; nothing to repair");
  if (o.holes == Holes::fill) refuse_flat_components(result, name);
  result = unite_crossing_components(result, notes);
  const SurfaceDefects united = find_defects(result);
  const bool apart = !sheets_cross(result, united);
  if (apart && !united.crossings.empty()) result = without_crossings(result, united, notes);
  m = to_cgal(result);
  if (find_defects(result).crossings.empty()) orient_outwards(m, notes);
  result = from_cgal(m);
  drop_unused_vertices(result);
  const SurfaceDefects after = find_defects(result);
  const bool open_on_purpose = kept > 0 && !after.closed() && after.degenerate.empty() && after.manifold() && after.flipped.empty() &&
                             after.crossings.empty();
  if (!after.bounds_volume() && !open_on_purpose) refuse(input, before, after, result, name, apart ? "" : crossing_sheets_remedy);
  if (notes.empty()) notes.push_back("nothing to repair");
  return result;
}

}  // namespace tack
