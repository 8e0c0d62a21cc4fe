#include "geometry/shapes/surfaces.hpp"

#include <random>

#include "geometry/errors.hpp"
#include "geometry/mesh/cleanup.hpp"
#include "geometry/shapes/checks.hpp"

namespace tack {
namespace {

// Adds two triangles for the cell with the corners (0,0), (1,0), (1,1), (0,1), listed in the sense of
// rotation of the normal. from_origin: the diagonal starts at (0,0).
void add_cell(Mesh& mesh, const std::array<int, 4>& corner, bool from_origin) {
  const auto& [a, b, c, d] = corner;
  if (from_origin) {
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({a, c, d});
  } else {
    mesh.triangles.push_back({a, b, d});
    mesh.triangles.push_back({b, c, d});
  }
}

// Adds a side of the box: the plane axis = -size/2 (end 0) or +size/2 (end 1).
void add_side(Mesh& mesh, const Vec3& size, const std::array<int, 3>& cells, int axis, int end) {
  // On the lower side u and v are exchanged, which reverses the normal.
  const int u = (axis + (end ? 1 : 2)) % 3, v = (axis + (end ? 2 : 1)) % 3;
  const int first = static_cast<int>(mesh.vertices.size()), row = cells[u] + 1;
  for (int j = 0; j <= cells[v]; ++j) {
    for (int i = 0; i <= cells[u]; ++i) {
      Vec3 at;
      at[axis] = end;
      at[u] = double(i) / cells[u];
      at[v] = double(j) / cells[v];
      mesh.vertices.push_back(-0.5 * size + size.cwiseProduct(at));
    }
  }
  for (int j = 0; j < cells[v]; ++j) {
    for (int i = 0; i < cells[u]; ++i) {
      const int a = first + i + row * j;
      add_cell(mesh, {a, a + 1, a + 1 + row, a + row}, true);
    }
  }
}

// Corners of an icosahedron (golden rectangles) and its sides, normals outward.
constexpr double golden = 1.6180339887498948482;
const std::array<Vec3, 12> icosahedron = {
    Vec3(-1, golden, 0), Vec3(1, golden, 0), Vec3(-1, -golden, 0), Vec3(1, -golden, 0),
    Vec3(0, -1, golden), Vec3(0, 1, golden), Vec3(0, -1, -golden), Vec3(0, 1, -golden),
    Vec3(golden, 0, -1), Vec3(golden, 0, 1), Vec3(-golden, 0, -1), Vec3(-golden, 0, 1)};
constexpr std::array<Triangle, 20> sides = {
    {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
     {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
     {3, 8, 9},  {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};

// Adds rows of points parallel to side (a, b); row j shrinks towards c.
void add_subdivided(Mesh& mesh, const Triangle& side, double radius, int cells) {
  const auto& [a, b, c] = side;
  int row = static_cast<int>(mesh.vertices.size());
  for (int j = 0; j <= cells; ++j) {
    for (int i = 0; i <= cells - j; ++i) {
      const Vec3 x = (cells - i - j) * icosahedron[a] + i * icosahedron[b] + j * icosahedron[c];
      mesh.vertices.push_back(radius * x.normalized());
    }
  }
  for (int j = 0; j < cells; ++j) {
    const int next = row + cells - j + 1;
    for (int i = 0; i < cells - j; ++i) {
      mesh.triangles.push_back({row + i, row + i + 1, next + i});
      if (i > 0) mesh.triangles.push_back({row + i, next + i, next + i - 1});
    }
    row = next;
  }
}

}  // namespace

Mesh grid(const Vec2& size, const std::array<int, 2>& cells, Diagonals diagonals, double jitter, int seed) {
  for (int axis = 0; axis < 2; ++axis) {
    require_positive("grid", "size", size[axis]);
    require_at_least("grid", "the number of cells", cells[axis], 1);
  }
  if (!(jitter >= 0 && jitter < 0.25)) throw InputError("grid: jitter must be from 0 to below a quarter of a cell");
  const int row = cells[0] + 1;
  require_count("grid", double(row) * (cells[1] + 1.0));
  Mesh mesh;
  for (int k = 0; k <= cells[1]; ++k) {
    for (int i = 0; i <= cells[0]; ++i) {
      mesh.vertices.emplace_back(-0.5 * size[0] + size[0] * (double(i) / cells[0]), 0,
                                 -0.5 * size[1] + size[1] * (double(k) / cells[1]));
    }
  }
  if (jitter > 0) {
    std::mt19937 random(static_cast<std::mt19937::result_type>(seed));
    // Not std::uniform_real_distribution, which differs between libraries.
    const auto offset = [&] { return jitter * (2 * (random() / 4294967296.0) - 1); };
    for (int k = 1; k < cells[1]; ++k) {
      for (int i = 1; i < cells[0]; ++i) {
        const double x = offset() * size[0] / cells[0], z = offset() * size[1] / cells[1];
        mesh.vertices[static_cast<size_t>(i + row * k)] += Vec3(x, 0, z);
      }
    }
  }
  for (int k = 0; k < cells[1]; ++k) {
    for (int i = 0; i < cells[0]; ++i) {
      const int a = i + row * k;
      const bool odd = (i + k) % 2 == 1 && diagonals == Diagonals::alternating;
      // The sense from z to x has the normal +y.
      add_cell(mesh, {a, a + row, a + row + 1, a + 1}, !odd);
    }
  }
  return mesh;
}

Mesh box_surface(const Vec3& size, const std::array<int, 3>& cells) {
  double vertices = 0;
  for (int axis = 0; axis < 3; ++axis) {
    require_positive("box_surface", "size", size[axis]);
    require_at_least("box_surface", "the number of cells", cells[axis], 1);
    vertices += 2 * (cells[axis] + 1.0) * (cells[(axis + 1) % 3] + 1.0);
  }
  require_count("box_surface", vertices);
  Mesh mesh;
  for (int axis = 0; axis < 3; ++axis) {
    for (int end = 0; end < 2; ++end) add_side(mesh, size, cells, axis, end);
  }
  merge_duplicate_vertices(mesh);  // both sides of an edge compute its nodes by the same formula
  return mesh;
}

Mesh sphere_surface(double radius, int cells) {
  require_positive("sphere_surface", "radius", radius);
  require_at_least("sphere_surface", "the number of cells", cells, 1);
  require_count("sphere_surface", 10.0 * (cells + 2.0) * (cells + 2.0));
  Mesh mesh;
  for (const Triangle& side : sides) add_subdivided(mesh, side, radius, cells);
  merge_duplicate_vertices(mesh, 1e-9 * radius);  // sides round their common nodes differently
  return mesh;
}

}  // namespace tack
