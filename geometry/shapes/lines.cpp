#include "geometry/shapes/lines.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/errors.hpp"
#include "geometry/shapes/checks.hpp"

namespace tack {
namespace {

Vec3 around_y(double radius, double angle, double height) { return {radius * std::cos(angle), height, -radius * std::sin(angle)}; }

// Adds edges from one vertex to another along a straight line; returns the vertices between them.
std::vector<int> add_thread(Mesh& mesh, int from, int to, int edges) {
  std::vector<int> inner;
  const Vec3 start = mesh.vertices[from], end = mesh.vertices[to];
  int last = from;
  for (int i = 1; i < edges; ++i) {
    inner.push_back(static_cast<int>(mesh.vertices.size()));
    mesh.vertices.push_back(start + (end - start) * (double(i) / edges));
    mesh.edges.push_back({last, inner.back()});
    last = inner.back();
  }
  mesh.edges.push_back({last, to});
  return inner;
}

}  // namespace

Mesh segment(double length, int edges) {
  require_positive("segment", "length", length);
  require_at_least("segment", "the number of edges", edges, 1);
  require_count("segment", edges + 1.0);
  Mesh mesh;
  for (int i = 0; i <= edges; ++i) {
    mesh.vertices.emplace_back(-0.5 * length + length * (double(i) / edges), 0, 0);
  }
  for (int i = 0; i < edges; ++i) mesh.edges.push_back({i, i + 1});
  return mesh;
}

Mesh ring(double radius, int edges) {
  require_positive("ring", "radius", radius);
  require_at_least("ring", "the number of edges", edges, 3);
  require_count("ring", edges);
  Mesh mesh;
  for (int i = 0; i < edges; ++i) {
    mesh.vertices.push_back(around_y(radius, 2 * std::numbers::pi * i / edges, 0));
    mesh.edges.push_back({i, (i + 1) % edges});
  }
  return mesh;
}

Mesh helix(double radius, double pitch, double turns, int edges) {
  require_positive("helix", "radius", radius);
  require_positive("helix", "pitch", pitch);
  require_positive("helix", "the number of turns", turns);
  require_at_least("helix", "the number of edges", edges, 1);
  require_count("helix", edges + 1.0);
  Mesh mesh;
  for (int i = 0; i <= edges; ++i) {
    const double turn = turns * i / edges;
    mesh.vertices.push_back(around_y(radius, 2 * std::numbers::pi * turn, pitch * (turn - turns / 2)));
    if (i > 0) mesh.edges.push_back({i - 1, i});
  }
  return mesh;
}

Mesh net(const Vec2& size, const std::array<int, 2>& cells, int edges) {
  for (int axis = 0; axis < 2; ++axis) {
    require_positive("net", "size", size[axis]);
    require_at_least("net", "the number of cells", cells[axis], 1);
  }
  require_at_least("net", "the number of edges", edges, 1);
  require_count("net", (cells[0] + 1.0) * (cells[1] + 1.0) * 2 * edges);
  Mesh mesh;
  const auto on_outline = [&](int v) { mesh.tags["border"].push_back(v); };
  for (int j = 0; j <= cells[1]; ++j)
    for (int i = 0; i <= cells[0]; ++i) {
      if (i == 0 || i == cells[0] || j == 0 || j == cells[1]) on_outline(static_cast<int>(mesh.vertices.size()));
      mesh.tags["knots"].push_back(static_cast<int>(mesh.vertices.size()));
      mesh.vertices.emplace_back(size[0] * (double(i) / cells[0] - 0.5), 0, size[1] * (double(j) / cells[1] - 0.5));
    }
  const auto knot = [&](int i, int j) { return i + (cells[0] + 1) * j; };
  const auto side = [&](int from, int to, bool outer) {
    for (const int v : add_thread(mesh, from, to, edges))
      if (outer) on_outline(v);
  };
  for (int j = 0; j <= cells[1]; ++j)
    for (int i = 0; i <= cells[0]; ++i) {
      if (i < cells[0]) side(knot(i, j), knot(i + 1, j), j == 0 || j == cells[1]);
      if (j < cells[1]) side(knot(i, j), knot(i, j + 1), i == 0 || i == cells[0]);
    }
  return mesh;
}

Mesh web(double radius, double inner_radius, int spokes, int turns, double edge_length) {
  require_positive("web", "radius", radius);
  require_positive("web", "inner radius", inner_radius);
  require_positive("web", "edge length", edge_length);
  require_at_least("web", "the number of spokes", spokes, 3);
  require_at_least("web", "the number of turns", turns, 1);
  if (!(inner_radius < radius)) throw InputError("web: the inner radius must be smaller than the radius");
  const int crossings = spokes * turns;
  require_count("web", crossings + spokes * radius / edge_length + 2 * std::numbers::pi * radius * turns / edge_length);
  Mesh mesh;
  mesh.vertices.push_back(Vec3::Zero());
  mesh.tags["centre"] = {0};
  std::vector<int>& spiral = mesh.tags["spiral"];
  std::vector<int> last(spokes, 0);  // last vertex of each spoke
  const auto connect = [&](int from, int to) {
    const double length = (mesh.vertices[to] - mesh.vertices[from]).norm();
    return add_thread(mesh, from, to, std::max(1, static_cast<int>(std::ceil(length / edge_length - 1e-9))));
  };
  // The spokes extend beyond the last turn by half the distance of two turns.
  const double rise = (radius - inner_radius) / (turns + 0.5);
  const auto add_on_spoke = [&](int s, double r) {
    const int v = static_cast<int>(mesh.vertices.size());
    mesh.vertices.push_back(around_y(r, 2 * std::numbers::pi * s / spokes, 0));
    connect(last[s], v);
    return last[s] = v;
  };
  int before = -1;
  for (int k = 0; k <= crossings; ++k) {
    const int v = add_on_spoke(k % spokes, inner_radius + rise * k / spokes);
    spiral.push_back(v);
    if (before >= 0)
      for (const int inner : connect(before, v)) spiral.push_back(inner);
    before = v;
  }
  for (int s = 0; s < spokes; ++s) mesh.tags["ends"].push_back(add_on_spoke(s, radius));
  std::sort(spiral.begin(), spiral.end());
  return mesh;
}

Mesh point_grid(const Vec3& size, const std::array<int, 3>& counts) {
  double vertices = 1;
  for (int axis = 0; axis < 3; ++axis) {
    require_at_least("point_grid", "the number of points", counts[axis], 1);
    if (counts[axis] > 1) require_positive("point_grid", "size", size[axis]);
    vertices *= counts[axis];
  }
  require_count("point_grid", vertices);
  const auto coordinate = [&](int axis, int i) {
    if (counts[axis] == 1) return 0.0;
    return -0.5 * size[axis] + size[axis] * (double(i) / (counts[axis] - 1));
  };
  Mesh mesh;
  for (int k = 0; k < counts[2]; ++k) {
    for (int j = 0; j < counts[1]; ++j) {
      for (int i = 0; i < counts[0]; ++i) {
        mesh.points.push_back(static_cast<int>(mesh.vertices.size()));
        mesh.vertices.emplace_back(coordinate(0, i), coordinate(1, j), coordinate(2, k));
      }
    }
  }
  return mesh;
}

}  // namespace tack
