#include "geometry/shapes/lines.hpp"

#include <numbers>

#include "geometry/shapes/checks.hpp"

namespace tack {
namespace {

Vec3 around_y(double radius, double angle, double height) { return {radius * std::cos(angle), height, -radius * std::sin(angle)}; }

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
    const double turned = turns * i / edges;
    mesh.vertices.push_back(around_y(radius, 2 * std::numbers::pi * turned, pitch * (turned - turns / 2)));
    if (i > 0) mesh.edges.push_back({i - 1, i});
  }
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
