// Small collision meshes for the broad phase tests: triangle soups, sheets, rods and particles.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "geometry/mesh/collision_mesh.hpp"

namespace tack::scenes {

struct Scene {
  CollisionMesh mesh;
  std::vector<double> coordinates;

  int add_vertex(const Vec3& position, int object) {
    coordinates.insert(coordinates.end(), {position[0], position[1], position[2]});
    mesh.vertices.push_back(static_cast<int>(mesh.vertex_object.size()));
    mesh.vertex_object.push_back(object);
    mesh.vertex_movable.push_back(1);
    return mesh.vertices.back();
  }
  void add_triangle(const Triangle& t) {
    mesh.triangles.push_back(t);
    for (int k = 0; k < 3; ++k) add_edge(t[k], t[(k + 1) % 3]);
  }
  void add_edge(int a, int b) {
    const Edge edge{std::min(a, b), std::max(a, b)};
    auto& edges = mesh.edges;
    if (std::find(edges.begin(), edges.end(), edge) == edges.end()) edges.push_back(edge);
  }
  void add_rod_edge(int a, int b) {
    mesh.codim_edges.push_back(static_cast<int>(mesh.edges.size()));
    mesh.edges.push_back({a, b});
  }
  void add_particle(const Vec3& position, int object) {
    mesh.codim_points.push_back(add_vertex(position, object));
  }
  // n x n vertices at position(u, v) with u, v in [0, 1].
  void add_sheet(int n, int object, const std::function<Vec3(double, double)>& position) {
    const int first = static_cast<int>(mesh.vertex_object.size());
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) add_vertex(position(i / (n - 1.0), j / (n - 1.0)), object);
    for (int j = 0; j + 1 < n; ++j)
      for (int i = 0; i + 1 < n; ++i) {
        const int a = first + j * n + i, b = a + 1, c = a + n + 1, d = a + n;
        add_triangle({a, b, (i + j) % 2 ? d : c});
        add_triangle({(i + j) % 2 ? b : a, c, d});
      }
  }
  void freeze(int object) {
    for (const int v : mesh.vertices)
      if (mesh.vertex_object[v] == object) mesh.vertex_movable[v] = 0;
  }
  VecX x() const { return Eigen::Map<const VecX>(coordinates.data(), coordinates.size()); }
};

inline Vec3 random_point(std::mt19937& random, double size) {
  std::uniform_real_distribution<double> coordinate(-size, size);
  return {coordinate(random), coordinate(random), coordinate(random)};
}

inline VecX random_motion(std::mt19937& random, Eigen::Index size, double bound) {
  std::uniform_real_distribution<double> coordinate(-bound, bound);
  return VecX::NullaryExpr(size, [&] { return coordinate(random); });
}

// Loose triangles in a cube, dealt to three objects in turn, so that objects do not ascend.
inline Scene triangle_soup(int triangles) {
  std::mt19937 random(7);
  Scene scene;
  for (int t = 0; t < triangles; ++t) {
    const Vec3 centre = random_point(random, 0.5);
    Triangle corners;
    for (int& v : corners) v = scene.add_vertex(centre + random_point(random, 0.06), 2 - t % 3);
    scene.add_triangle(corners);
  }
  return scene;
}

inline Scene two_sheets(int n, double gap) {
  Scene scene;
  scene.add_sheet(n, 0, [](double u, double v) { return Vec3(u, v, 0.0); });
  scene.add_sheet(n, 1, [&](double u, double v) {
    return Vec3(std::cos(0.12) * u - std::sin(0.12) * v, std::sin(0.12) * u + std::cos(0.12) * v,
                gap);
  });
  return scene;
}

// One sheet bent by 180 degrees, its halves `gap` apart.
inline Scene folded_sheet(int n, double gap) {
  Scene scene;
  scene.add_sheet(n, 0, [&](double u, double v) {
    const double angle = M_PI * std::clamp((u - 0.45) / 0.1, 0.0, 1.0);
    const double arm = u < 0.5 ? std::max(0.45 - u, 0.0) : std::max(u - 0.55, 0.0);
    return Vec3(0.5 * gap * std::sin(angle) - arm, v, 0.5 * gap * (1.0 - std::cos(angle)));
  });
  return scene;
}

// A sheet, zigzag rods above it and particles among them.
inline Scene mixed(int rods, int particles) {
  std::mt19937 random(11);
  Scene scene;
  scene.add_sheet(9, 0, [](double u, double v) { return Vec3(u - 0.5, v - 0.5, 0.1 * u * v); });
  for (int r = 0; r < rods; ++r) {
    int last = scene.add_vertex(random_point(random, 0.5), 1 + r % 2);
    for (int k = 0; k < 10; ++k) {
      const Vec3 here = Eigen::Map<const Vec3>(&scene.coordinates[3 * last]);
      const int next = scene.add_vertex(here + random_point(random, 0.1), 1 + r % 2);
      scene.add_rod_edge(last, next);
      last = next;
    }
  }
  for (int k = 0; k < particles; ++k) scene.add_particle(random_point(random, 0.5), 3);
  return scene;
}

}  // namespace tack::scenes
