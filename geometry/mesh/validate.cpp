#include "geometry/mesh/validate.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "geometry/errors.hpp"
#include "geometry/mesh/overlaps.hpp"
#include "geometry/mesh/quality.hpp"
#include "geometry/mesh/sorted.hpp"

namespace tack {
namespace {

// Relative size below which rounding alone decides the sign of a volume.
constexpr double flat = 1e-14;

// Calls visit(kind, number, indices, count) for every element of every dimension.
template <class Visit>
void for_each_element(const Mesh& mesh, const Visit& visit) {
  const auto all = [&](const char* kind, const auto& elements) {
    for (int e = 0; e < static_cast<int>(elements.size()); ++e) {
      visit(kind, e, elements[e].data(), static_cast<int>(elements[e].size()));
    }
  };
  all("tet", mesh.tets);
  all("triangle", mesh.triangles);
  all("edge", mesh.edges);
  for (int p = 0; p < static_cast<int>(mesh.points.size()); ++p) {
    visit("point", p, &mesh.points[p], 1);
  }
}

std::string describe(const std::string& name, const char* kind, int number, const int* v, int n) {
  return fmt::format("{}: {} {} (vertices {})", name, kind, number, fmt::join(v, v + n, " "));
}

double longest_squared_edge(const Mesh& mesh, const int* v, int n) {
  double longest = 0;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < i; ++j) {
      longest = std::max(longest, (mesh.vertices[v[i]] - mesh.vertices[v[j]]).squaredNorm());
    }
  }
  return longest;
}

void check_repeats(const Mesh& mesh, const std::string& name) {
  for_each_element(mesh, [&](const char* kind, int number, const int* v, int n) {
    for (int i = 0; i < n; ++i) {
      if (std::find(v, v + i, v[i]) == v + i) continue;
      throw InputError(describe(name, kind, number, v, n) + " uses a vertex twice: remove it");
    }
  });
}

void check_tets(const Mesh& mesh, const std::string& name) {
  for (int t = 0; t < static_cast<int>(mesh.tets.size()); ++t) {
    const int* v = mesh.tets[t].data();
    const double volume = tet_volume(mesh, t);
    const double size = std::pow(longest_squared_edge(mesh, v, 4), 1.5);
    if (volume > flat * size) continue;
    const bool inverted = volume < -flat * size;
    throw InputError(fmt::format("{} is {} (volume {:.3g} m^3): {} or remesh",
                                 describe(name, "tet", t, v, 4), inverted ? "inverted" : "flat",
                                 volume,
                                 inverted ? "swap two of its vertices" : "move one off the plane"));
  }
}

void check_triangles_and_edges(const Mesh& mesh, const std::string& name) {
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
    const int* v = mesh.triangles[t].data();
    if (triangle_area(mesh, t) > flat * longest_squared_edge(mesh, v, 3)) continue;
    throw InputError(describe(name, "triangle", t, v, 3) +
                     " has no area: remove it or merge its vertices");
  }
  for (int e = 0; e < static_cast<int>(mesh.edges.size()); ++e) {
    const int* v = mesh.edges[e].data();
    if (longest_squared_edge(mesh, v, 2) > 0) continue;
    throw InputError(describe(name, "edge", e, v, 2) + " has no length: merge its vertices");
  }
}

void check_unused(const Mesh& mesh, const std::string& name) {
  std::vector<char> used(mesh.vertices.size(), 0);
  for_each_element(mesh, [&](const char*, int, const int* v, int n) {
    for (int i = 0; i < n; ++i) used[v[i]] = 1;
  });
  const auto unused = std::find(used.begin(), used.end(), 0);
  if (unused == used.end()) return;
  throw InputError(fmt::format("{}: vertex {} belongs to no element ({} such vertices): remove it "
                               "or make it a point element",
                               name, unused - used.begin(),
                               std::count(used.begin(), used.end(), 0)));
}

void check_overlaps(const Mesh& mesh, const std::string& name) {
  const auto pairs = overlapping_tets(mesh);
  if (pairs.empty()) return;
  const auto [s, t] = pairs.front();
  const Tet &a = mesh.tets[s], &b = mesh.tets[t];
  Vec3 middle = Vec3::Zero();
  for (const int v : b) middle += mesh.vertices[v] / 4;
  throw InputError(fmt::format("{} and tet {} (vertices {}) {}, near ({:.6g}, {:.6g}, {:.6g}) m ({} such pairs): remove "
                               "one of them or remesh", describe(name, "tet", s, a.data(), 4), t, fmt::join(b, " "),
                               sorted(a) == sorted(b) ? "are the same" : "overlap", middle.x(), middle.y(), middle.z(),
                               pairs.size()));
}

std::vector<Triangle> sorted_faces_of_tets(const Mesh& mesh) {
  std::vector<Triangle> faces;
  for (const Tet& tet : mesh.tets) {
    const auto [a, b, c, d] = sorted(tet);
    for (const Triangle& face : {Triangle{a, b, c}, Triangle{a, b, d}, Triangle{a, c, d}, Triangle{b, c, d}}) faces.push_back(face);
  }
  std::sort(faces.begin(), faces.end());
  return faces;
}

std::vector<Edge> sorted_edges_of_triangles_and_tets(const Mesh& mesh) {
  std::vector<Edge> edges;
  const auto add = [&](const auto& elements) {
    for (const auto& element : elements)
      for (size_t i = 0; i < element.size(); ++i)
        for (size_t j = 0; j < i; ++j) edges.push_back(sorted(Edge{element[i], element[j]}));
  };
  add(mesh.triangles);
  add(mesh.tets);
  std::sort(edges.begin(), edges.end());
  return edges;
}

// Throws InputError for an element that is listed twice. Elements that are faces or edges of larger ones are ignored: they are not
// part of the surface. on_larger: returns those faces or edges, sorted, each with its vertices ascending.
template <class Element, class OnLarger>
void check_doubled(const Mesh& mesh, const std::vector<Element>& elements, const char* kind, const OnLarger& on_larger, const std::string& name) {
  std::vector<std::pair<Element, int>> found;  // by their vertices
  for (int e = 0; e < static_cast<int>(elements.size()); ++e) found.emplace_back(sorted(elements[e]), e);
  std::sort(found.begin(), found.end());
  std::optional<std::vector<Element>> larger;
  for (size_t i = 1; i < found.size(); ++i) {
    if (found[i].first != found[i - 1].first) continue;
    if (!larger) larger = on_larger(mesh);
    if (std::binary_search(larger->begin(), larger->end(), found[i].first)) continue;
    const int first = found[i - 1].second, second = found[i].second;
    throw InputError(fmt::format("{} and {} {} (vertices {}) are the same: remove one of them",
                                 describe(name, kind, first, elements[first].data(), static_cast<int>(elements[first].size())), kind, second,
                                 fmt::join(elements[second], " ")));
  }
}

}  // namespace

void validate_indices(const Mesh& mesh, const std::string& name) {
  const int count = static_cast<int>(mesh.vertices.size());
  const auto check = [&](const std::string& what, const int* v, int n) {
    for (int i = 0; i < n; ++i) {
      if (v[i] >= 0 && v[i] < count) continue;
      throw InputError(fmt::format("{} refers to vertex {} (counted from 0) of {}: correct the "
                                   "index or add the vertex",
                                   what, v[i], count));
    }
  };
  for_each_element(mesh, [&](const char* kind, int number, const int* v, int n) {
    const auto in_range = [count](int i) { return i >= 0 && i < count; };
    if (!std::all_of(v, v + n, in_range)) check(describe(name, kind, number, v, n), v, n);
  });
  for (const auto& [tag, group] : mesh.tags) {
    check(fmt::format("{}: group \"{}\"", name, tag), group.data(), static_cast<int>(group.size()));
  }
}

void validate_coordinates(const Mesh& mesh, const std::string& name) {
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const Vec3& x = mesh.vertices[i];
    if (x.allFinite()) continue;
    throw InputError(fmt::format("{}: vertex {} is at ({}, {}, {}): coordinates have to be finite",
                                 name, i, x.x(), x.y(), x.z()));
  }
}

void validate_mesh(const Mesh& mesh, const std::string& name) {
  if (mesh.tets.empty() && mesh.triangles.empty() && mesh.edges.empty() && mesh.points.empty()) {
    throw InputError(name + ": the mesh has no element: give tets, triangles, edges or points");
  }
  validate_indices(mesh, name);
  validate_coordinates(mesh, name);
  check_repeats(mesh, name);
  check_tets(mesh, name);
  check_triangles_and_edges(mesh, name);
  check_unused(mesh, name);
  check_overlaps(mesh, name);
  check_doubled(mesh, mesh.triangles, "triangle", sorted_faces_of_tets, name);
  check_doubled(mesh, mesh.edges, "edge", sorted_edges_of_triangles_and_tets, name);
}

}  // namespace tack
