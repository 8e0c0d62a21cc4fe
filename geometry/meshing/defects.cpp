#include "geometry/meshing/defects.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>

#include "geometry/errors.hpp"
#include "geometry/mesh/triangle_surface.hpp"

namespace tack {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;

Point point(const Vec3& v) { return {v[0], v[1], v[2]}; }

bool repeats_vertex(const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; }

Triangle sorted(Triangle t) {
  std::sort(t.begin(), t.end());
  return t;
}

struct Uses {
  std::vector<int> along, against;  // triangles with the edge from the smaller to the larger vertex, and with the opposite one
  std::size_t count() const { return along.size() + against.size(); }
};

using EdgeUses = std::map<Edge, Uses>;

EdgeUses edge_uses(const std::vector<Triangle>& triangles) {
  EdgeUses uses;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (repeats_vertex(triangles[t])) continue;
    for (int i = 0; i < 3; ++i) {
      const int a = triangles[t][i], b = triangles[t][(i + 1) % 3];
      Uses& use = uses[{std::min(a, b), std::max(a, b)}];
      (a < b ? use.along : use.against).push_back(static_cast<int>(t));
    }
  }
  return uses;
}

void find_degenerate(const Mesh& m, SurfaceDefects& d) {
  for (std::size_t t = 0; t < m.triangles.size(); ++t) {
    const auto& [a, b, c] = m.triangles[t];
    if (repeats_vertex(m.triangles[t]) || CGAL::collinear(point(m.vertices[a]), point(m.vertices[b]), point(m.vertices[c])))
      d.degenerate.push_back(static_cast<int>(t));
  }
}

void find_duplicates(const Mesh& m, SurfaceDefects& d) {
  std::map<Triangle, int> first;
  for (std::size_t t = 0; t < m.triangles.size(); ++t) {
    const int number = static_cast<int>(t);
    const auto [seen, is_new] = first.emplace(sorted(m.triangles[t]), number);
    if (!is_new) d.duplicates.push_back({seen->second, number});
  }
  std::sort(d.duplicates.begin(), d.duplicates.end());
}

void find_doubled_vertices(const Mesh& m, SurfaceDefects& d) {
  std::vector<int> order(m.vertices.size());
  std::iota(order.begin(), order.end(), 0);
  const auto before = [&](int a, int b) {
    const Vec3 &x = m.vertices[a], &y = m.vertices[b];
    return std::tuple(x[0], x[1], x[2], a) < std::tuple(y[0], y[1], y[2], b);
  };
  std::sort(order.begin(), order.end(), before);
  for (std::size_t i = 1, first = 0; i < order.size(); ++i) {
    if (m.vertices[order[i]] == m.vertices[order[first]]) {
      d.doubled_vertices.push_back({order[first], order[i]});
    } else {
      first = i;
    }
  }
  std::sort(d.doubled_vertices.begin(), d.doubled_vertices.end());
}

void find_edge_defects(const EdgeUses& uses, SurfaceDefects& d) {
  for (const auto& [edge, use] : uses) {
    if (use.count() > 2) {
      std::vector<int> triangles = use.along;
      triangles.insert(triangles.end(), use.against.begin(), use.against.end());
      std::sort(triangles.begin(), triangles.end());
      d.crowded_edges.push_back({edge, triangles});
    } else if (use.count() == 1) {
      if (use.along.empty()) {
        d.open_edges.push_back({use.against[0], {edge[1], edge[0]}});
      } else {
        d.open_edges.push_back({use.along[0], edge});
      }
    } else if (use.along.size() != 1) {
      const std::vector<int>& both = use.along.empty() ? use.against : use.along;
      d.flipped.push_back({std::min(both[0], both[1]), std::max(both[0], both[1])});
    }
  }
  std::sort(d.flipped.begin(), d.flipped.end());
}

// Finds pinched vertices: their triangles, connected by edges at the vertex, are more than one fan.
void find_pinched_vertices(const Mesh& m, SurfaceDefects& d) {
  std::vector<std::vector<int>> around(m.vertices.size());
  for (std::size_t t = 0; t < m.triangles.size(); ++t)
    if (!repeats_vertex(m.triangles[t]))
      for (const int v : m.triangles[t]) around[v].push_back(static_cast<int>(t));
  for (std::size_t v = 0; v < around.size(); ++v) {
    std::vector<int> reached = around[v].empty() ? std::vector<int>() : std::vector<int>{around[v][0]}, left(around[v]);
    if (!left.empty()) left.erase(left.begin());
    for (std::size_t i = 0; i < reached.size(); ++i) {
      const auto touches = [&](int t) {
        int shared = 0;
        for (const int a : m.triangles[t])
          for (const int b : m.triangles[reached[i]]) shared += a == b;
        return shared >= 2;
      };
      const auto next = std::stable_partition(left.begin(), left.end(), [&](int t) { return !touches(t); });
      reached.insert(reached.end(), next, left.end());
      left.erase(next, left.end());
    }
    if (!left.empty()) d.pinched_vertices.push_back(static_cast<int>(v));
  }
}

int count_cycles(const std::vector<OpenEdge>& open) {
  std::map<int, int> root;
  for (const OpenEdge& e : open) root[e.edge[0]] = e.edge[0], root[e.edge[1]] = e.edge[1];
  const auto find = [&](int v) {
    while (root[v] != v) v = root[v] = root[root[v]];
    return v;
  };
  for (const OpenEdge& e : open) root[find(e.edge[1])] = find(e.edge[0]);
  return static_cast<int>(std::count_if(root.begin(), root.end(), [](const auto& r) { return r.first == r.second; }));
}

// Predicate: two non-degenerate triangles meet in more than their common vertices.
class Crossing {
 public:
  explicit Crossing(const Mesh& mesh) : mesh_(mesh) {}

  bool operator()(int s, int t) const {
    Triangle a = mesh_.triangles[s], b = mesh_.triangles[t];
    const int shared = shared_first(a, b);
    if (shared == 3) return false;  // a duplicate
    if (shared == 2) {
      const Point p = at(a[0]), q = at(a[1]), r = at(a[2]), u = at(b[2]);
      return CGAL::orientation(p, q, r, u) == CGAL::COPLANAR && CGAL::coplanar_orientation(p, q, r, u) == CGAL::POSITIVE;
    }
    if (shared == 1) return CGAL::do_intersect(triangle(a), opposite(b)) || CGAL::do_intersect(triangle(b), opposite(a));
    return CGAL::do_intersect(triangle(a), triangle(b));
  }

 private:
  // Moves common vertices to the front of both triangles, in the same order; returns their number.
  static int shared_first(Triangle& a, Triangle& b) {
    int shared = 0;
    for (int i = 0; i < 3; ++i) {
      const auto found = std::find(b.begin() + shared, b.end(), a[i]);
      if (found == b.end()) continue;
      std::swap(*found, b[shared]);
      std::swap(a[i], a[shared]);
      ++shared;
    }
    return shared;
  }
  Point at(int v) const { return point(mesh_.vertices[v]); }
  Kernel::Triangle_3 triangle(const Triangle& t) const { return {at(t[0]), at(t[1]), at(t[2])}; }
  Kernel::Segment_3 opposite(const Triangle& t) const { return {at(t[1]), at(t[2])}; }

  const Mesh& mesh_;
};

struct CrossingLimitReached {};

void find_crossings(const Mesh& m, SurfaceDefects& d) {
  using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, int>;
  std::vector<Box> boxes;
  for (std::size_t t = 0; t < m.triangles.size(); ++t) {
    if (std::binary_search(d.degenerate.begin(), d.degenerate.end(), static_cast<int>(t))) continue;
    CGAL::Bbox_3 box;
    for (const int v : m.triangles[t]) box += point(m.vertices[v]).bbox();
    boxes.emplace_back(box, static_cast<int>(t));
  }
  const Crossing crossing(m);
  const auto check_pair = [&](const Box& a, const Box& b) {
    const int s = std::min(a.info(), b.info()), t = std::max(a.info(), b.info());
    if (!crossing(s, t)) return;
    d.crossings.push_back({s, t});
    if (d.crossings.size() >= crossing_count_max) throw CrossingLimitReached();
  };
  try {
    CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), check_pair);
  } catch (const CrossingLimitReached&) {
  }
  std::sort(d.crossings.begin(), d.crossings.end());
}

// Appends a line such as "12 open edges: 3-4 of triangle 7, ...".
template <class List, class Text>
void add_line(std::vector<std::string>& lines, const List& list, const char* one, const char* many, const Text& text) {
  if (list.empty()) return;
  std::string line = fmt::format("{} {}: ", list.size(), list.size() == 1 ? one : many);
  for (std::size_t i = 0; i < std::min<std::size_t>(list.size(), 10); ++i) line += (i ? ", " : "") + text(list[i]);
  lines.push_back(line + (list.size() > 10 ? ", ..." : ""));
}

void refuse(const SurfaceDefects& defects, const std::string& name, const char* demand) {
  std::string text = fmt::format("{}: {}", name, demand);
  for (const std::string& line : list_defects(defects)) text += "\n  " + line;
  throw InputError(text + "\n  remedy: `tack mesh repair FILE -o OUT`, or the step {type: repair}");
}

}  // namespace

bool SurfaceDefects::bounds_volume() const {
  return degenerate.empty() && manifold() && closed() && flipped.empty() && crossings.empty() && volume > 0;
}

SurfaceDefects find_defects(const Mesh& surface, bool crossings) {
  SurfaceDefects d;
  find_degenerate(surface, d);
  find_duplicates(surface, d);
  find_doubled_vertices(surface, d);
  find_edge_defects(edge_uses(surface.triangles), d);
  find_pinched_vertices(surface, d);
  if (crossings) find_crossings(surface, d);
  const std::vector<int> components = components_by_vertices(surface);
  d.component_count = components.empty() ? 0 : *std::max_element(components.begin(), components.end()) + 1;
  d.holes = count_cycles(d.open_edges);
  if (d.closed() && d.flipped.empty() && d.crowded_edges.empty() && !surface.triangles.empty()) d.volume = enclosed_volume_of(surface);
  return d;
}

std::vector<std::string> list_defects(const SurfaceDefects& d) {
  std::vector<std::string> lines;
  const auto number = [](int n) { return std::to_string(n); };
  const auto pair = [](const std::array<int, 2>& p) { return fmt::format("{} and {}", p[0], p[1]); };
  add_line(lines, d.degenerate, "degenerate triangle", "degenerate triangles", number);
  add_line(lines, d.duplicates, "duplicated triangle", "duplicated triangles", pair);
  add_line(lines, d.open_edges, "open edge", "open edges", [](const OpenEdge& e) {
    return fmt::format("{}-{} of triangle {}", e.edge[0], e.edge[1], e.triangle);
  });
  add_line(lines, d.crowded_edges, "edge of more than two triangles", "edges of more than two triangles", [](const CrowdedEdge& e) {
    return fmt::format("{}-{} of triangles {}", e.edge[0], e.edge[1], fmt::join(e.triangles, " "));
  });
  add_line(lines, d.pinched_vertices, "vertex in which surfaces touch", "vertices in which surfaces touch", number);
  add_line(lines, d.flipped, "pair of neighbours with normals on different sides: triangles",
           "pairs of neighbours with normals on different sides: triangles", pair);
  add_line(lines, d.crossings, "pair of triangles that cross",
           d.crossings.size() < crossing_count_max ? "pairs of triangles that cross" : "or more pairs of triangles that cross", pair);
  if (d.inside_out()) lines.push_back("inside out: its normals point inwards");
  return lines;
}

void require_solid(const Mesh& surface, const std::string& name) {
  const SurfaceDefects defects = find_defects(surface);
  if (!defects.bounds_volume()) refuse(defects, name, "needs a closed surface that does not cross itself, with normals outwards");
}

void require_oriented_manifold(const Mesh& surface, const std::string& name) {
  const SurfaceDefects defects = find_defects(surface, false);
  if (!defects.degenerate.empty() || !defects.manifold() || !defects.flipped.empty())
    refuse(defects, name, "needs a surface of which every edge has at most two triangles, with normals on the same side");
}

}  // namespace tack
