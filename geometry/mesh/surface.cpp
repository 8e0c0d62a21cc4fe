#include "geometry/mesh/surface.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <tuple>

#include "geometry/errors.hpp"
#include "geometry/mesh/quality.hpp"
#include "geometry/mesh/sorted.hpp"

namespace tack {
namespace {

// A face of a tet. `key`: its vertices, ascending, equal to that of the neighbour.
struct Face {
  Triangle key;
  int tet;
  int local;
};

// Face i is opposite corner i, and its normal points away from it in a positive tet.
constexpr std::array<Triangle, 4> outward = {{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

Edge sorted_edge(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

std::vector<Face> sorted_faces(const std::vector<Tet>& tets) {
  std::vector<Face> faces;
  faces.reserve(4 * tets.size());
  for (int t = 0; t < static_cast<int>(tets.size()); ++t) {
    for (int f = 0; f < 4; ++f) {
      const auto& [i, j, k] = outward[f];
      faces.push_back({sorted(Triangle{tets[t][i], tets[t][j], tets[t][k]}), t, f});
    }
  }
  std::sort(faces.begin(), faces.end(), [](const Face& a, const Face& b) {
    return std::tie(a.key, a.tet, a.local) < std::tie(b.key, b.tet, b.local);
  });
  return faces;
}

[[noreturn]] void refuse_shared_face(const Face& face) {
  throw InputError(fmt::format("more than two tets share the face with the vertices {} {} {} (tet "
                               "{} is one): remove duplicate or overlapping tets",
                               face.key[0], face.key[1], face.key[2], face.tet));
}

std::vector<Triangle> boundary(const std::vector<Tet>& tets, const std::vector<Face>& faces) {
  std::vector<char> is_boundary(4 * tets.size(), 0);
  for (std::size_t begin = 0, end = 0; begin < faces.size(); begin = end) {
    while (end < faces.size() && faces[end].key == faces[begin].key) ++end;
    if (end - begin > 2) refuse_shared_face(faces[begin]);
    if (end - begin == 1) is_boundary[4 * faces[begin].tet + faces[begin].local] = 1;
  }
  std::vector<Triangle> triangles;
  for (std::size_t t = 0; t < tets.size(); ++t) {
    for (int f = 0; f < 4; ++f) {
      const auto& [i, j, k] = outward[f];
      if (is_boundary[4 * t + f]) triangles.push_back({tets[t][i], tets[t][j], tets[t][k]});
    }
  }
  return triangles;
}

void add_explicit_triangles(const Mesh& mesh, const std::vector<Face>& faces, Surface& surface) {
  for (const Triangle& triangle : mesh.triangles) {
    const Triangle key = sorted(triangle);
    const auto at = std::lower_bound(faces.begin(), faces.end(), key,
                                     [](const Face& f, const Triangle& k) { return f.key < k; });
    if (at == faces.end() || at->key != key) surface.triangles.push_back(triangle);
  }
}

void add_edges(const Mesh& mesh, Surface& surface) {
  std::vector<Edge> of_triangles, rods;
  of_triangles.reserve(3 * surface.triangles.size());
  for (const auto& [a, b, c] : surface.triangles) {
    for (const Edge& e : {sorted_edge(a, b), sorted_edge(b, c), sorted_edge(c, a)}) {
      of_triangles.push_back(e);
    }
  }
  for (const auto& [a, b] : mesh.edges) rods.push_back(sorted_edge(a, b));
  sort_unique(of_triangles);
  sort_unique(rods);
  std::set_union(of_triangles.begin(), of_triangles.end(), rods.begin(), rods.end(),
                 std::back_inserter(surface.edges));
  for (std::size_t e = 0, t = 0; e < surface.edges.size(); ++e) {
    if (t < of_triangles.size() && of_triangles[t] == surface.edges[e]) {
      ++t;
    } else {
      surface.codim_edges.push_back(static_cast<int>(e));
    }
  }
}

void add_vertices(const Mesh& mesh, Surface& surface) {
  std::vector<char> in_tet(mesh.vertices.size(), 0), seen(mesh.vertices.size(), 0);
  for (const Tet& tet : mesh.tets) {
    for (int v : tet) in_tet[v] = 1;
  }
  for (const Edge& e : surface.edges) seen[e[0]] = seen[e[1]] = 1;
  for (int v : mesh.points) {
    if (!in_tet[v] && !seen[v]) surface.codim_points.push_back(v);
  }
  sort_unique(surface.codim_points);
  for (int v : surface.codim_points) seen[v] = 1;
  for (std::size_t v = 0; v < seen.size(); ++v) {
    if (seen[v]) surface.vertices.push_back(static_cast<int>(v));
  }
}

double area(const Mesh& mesh, const Triangle& t) {
  return triangle_area(mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]);
}

}  // namespace

Surface extract_surface(const Mesh& mesh) {
  Surface surface;
  const std::vector<Face> faces = sorted_faces(mesh.tets);
  surface.triangles = boundary(mesh.tets, faces);
  surface.first_sheet = static_cast<int>(surface.triangles.size());
  add_explicit_triangles(mesh, faces, surface);
  add_edges(mesh, surface);
  add_vertices(mesh, surface);
  return surface;
}

std::vector<double> vertex_areas(const Mesh& mesh, const Surface& surface) {
  std::vector<double> areas(mesh.vertices.size(), 0.0);
  for (const Triangle& t : surface.triangles) {
    const double third = area(mesh, t) / 3.0;
    for (int v : t) areas[v] += third;
  }
  return areas;
}

std::vector<double> edge_areas(const Mesh& mesh, const Surface& surface) {
  std::vector<double> areas(surface.edges.size(), 0.0);
  for (const Triangle& t : surface.triangles) {
    const double third = area(mesh, t) / 3.0;
    for (int i = 0; i < 3; ++i) {
      const Edge edge = sorted_edge(t[i], t[(i + 1) % 3]);
      const auto at = std::lower_bound(surface.edges.begin(), surface.edges.end(), edge);
      areas[at - surface.edges.begin()] += third;
    }
  }
  return areas;
}

}  // namespace tack
