#include "geometry/level_set/zero_surface.hpp"

#include <tbb/parallel_for.h>

#include <Eigen/Eigenvalues>
#include <set>

#include "geometry/exact/intersections.hpp"
#include "geometry/mesh/flip_slivers.hpp"
#include "geometry/mesh/surface.hpp"

namespace tack {
namespace {

struct Samples {
  std::vector<double> values;
  std::vector<Vec3> slopes;
};

// Returns values and slopes (central differences).
Samples sampled(const DistanceFunction& function, std::span<const Vec3> points, double step) {
  constexpr int probes = 7;
  std::vector<Vec3> at(probes * points.size());
  std::vector<double> f(at.size());
  for (size_t i = 0; i < points.size(); ++i) {
    at[probes * i] = points[i];
    for (int k = 0; k < 3; ++k) {
      at[probes * i + 1 + 2 * k] = points[i] + step * Vec3::Unit(k);
      at[probes * i + 2 + 2 * k] = points[i] - step * Vec3::Unit(k);
    }
  }
  function(at, f);
  Samples samples;
  for (size_t i = 0; i < points.size(); ++i) {
    const double* g = &f[probes * i];
    samples.values.push_back(g[0]);
    samples.slopes.emplace_back(Vec3(g[1] - g[2], g[3] - g[4], g[5] - g[6]) / (2 * step));
  }
  return samples;
}

using Boxes = std::vector<Eigen::AlignedBox3d>;

// Moves vertices to the zero of the function by Newton's method, each within its box. Returns the unit normals there; zero where the
// function is flat.
std::vector<Vec3> project_to_surface(std::vector<Vec3>& vertices, const DistanceFunction& function, double voxel, const Boxes& boxes) {
  constexpr int rounds = 4;
  std::vector<Vec3> normals(vertices.size());
  tbb::parallel_for(tbb::blocked_range<size_t>(0, vertices.size(), 256), [&](const auto& range) {
    const std::span<Vec3> x(&vertices[range.begin()], range.size());
    for (int round = 0; round <= rounds; ++round) {
      const Samples samples = sampled(function, x, 1e-3 * voxel);
      for (size_t i = 0; i < x.size(); ++i) {
        const Vec3& slope = samples.slopes[i];
        const double square = slope.squaredNorm();
        normals[range.begin() + i] = square < 1e-4 ? Vec3(Vec3::Zero()) : Vec3(slope.normalized());
        if (square < 1e-4 || round == rounds) continue;
        const Eigen::AlignedBox3d& box = boxes[range.begin() + i];
        x[i] = (x[i] - samples.values[i] / square * slope).cwiseMax(box.min()).cwiseMin(box.max());
      }
    }
  });
  return normals;
}

// Neighbours of vertices: those of vertex i are list[first[i]] to before list[first[i + 1]].
struct Rings {
  std::vector<int> first, list;
};

Rings rings_of(const Mesh& mesh) {
  Rings rings;
  rings.first.assign(mesh.vertices.size() + 1, 0);
  for (const Triangle& t : mesh.triangles)
    for (const int v : t) ++rings.first[v + 1];
  for (size_t i = 0; i + 1 < rings.first.size(); ++i) rings.first[i + 1] += rings.first[i];
  rings.list.resize(rings.first.back());
  std::vector<int> at(rings.first.begin(), rings.first.end() - 1);
  // On a closed surface, each neighbour follows the vertex in exactly one triangle.
  for (const Triangle& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) rings.list[at[t[k]]++] = t[(k + 1) % 3];
  return rings;
}

// Returns the point of the box that is closest to the planes of a vertex and its neighbours: on a corner, on a crease, or the vertex itself.
Vec3 crease_position(int v, const Mesh& mesh, const Rings& rings, const std::vector<Vec3>& normals, const Eigen::AlignedBox3d& box) {
  constexpr double small = 0.05;  // relative to the largest eigenvalue; smaller ones: no plane constrains that direction
  Mat3 squares = Mat3::Zero();
  Vec3 right = Vec3::Zero();
  const Vec3& x = mesh.vertices[v];
  const auto add = [&](int i) {
    squares += normals[i] * normals[i].transpose();
    right += normals[i] * normals[i].dot(mesh.vertices[i] - x);
  };
  add(v);
  for (int k = rings.first[v]; k < rings.first[v + 1]; ++k) add(rings.list[k]);
  const Eigen::SelfAdjointEigenSolver<Mat3> eigen(squares);
  for (int least = 0; least < 2; ++least) {
    Vec3 step = Vec3::Zero();
    for (int k = least; k < 3; ++k)
      if (eigen.eigenvalues()[k] > small * eigen.eigenvalues()[2])
        step += eigen.eigenvectors().col(k).dot(right) / eigen.eigenvalues()[k] * eigen.eigenvectors().col(k);
    if (box.contains(Vec3(x + step))) return x + step;
  }
  return x;
}

// Returns the vertices of triangles and edges that cross.
std::set<int> crossing_vertices(const Mesh& mesh) {
  const Surface surface = extract_surface(mesh);
  CollisionMesh all;
  all.vertices = surface.vertices;
  all.edges = surface.edges;
  all.triangles = surface.triangles;
  all.vertex_object.assign(mesh.vertices.size(), 0);
  all.vertex_movable.assign(mesh.vertices.size(), 1);
  VecX x(3 * mesh.vertices.size());
  for (size_t i = 0; i < mesh.vertices.size(); ++i) x.segment<3>(3 * i) = mesh.vertices[i];
  constexpr int most = 10000;
  std::set<int> vertices;
  for (const EdgeTriangleHit& hit : find_intersections(all, x, CollidingObjects(), most)) {
    vertices.insert(all.edges[hit.edge].begin(), all.edges[hit.edge].end());
    vertices.insert(all.triangles[hit.triangle].begin(), all.triangles[hit.triangle].end());
  }
  return vertices;
}

// Moves vertices back until no triangle crosses an edge. Where the surface is closer to itself than a voxel, moved vertices may have
// crossed it. They return to `before`, and to `at_first` if that does not help.
void undo_crossings(Mesh& mesh, const std::vector<Vec3>& before, const std::vector<Vec3>& at_first) {
  constexpr int rounds = 8;
  std::vector<char> back(mesh.vertices.size(), 0);
  for (int round = 0; round < rounds; ++round) {
    const std::set<int> vertices = crossing_vertices(mesh);
    if (vertices.empty()) return;
    for (const int v : vertices) {
      back[v] = back[v] || mesh.vertices[v] == before[v] ? 2 : 1;
      mesh.vertices[v] = back[v] == 1 ? before[v] : at_first[v];
    }
  }
}

}  // namespace

Mesh zero_surface(const DistanceFunction& function, const Eigen::AlignedBox3d& box, double voxel) {
  const DistanceGrid grid = DistanceGrid::of(function, box, voxel);
  Mesh mesh = grid.surface();
  constexpr double margin = 0.1;  // in voxels: vertices may leave their voxel by it; those on creases may not, or two would coincide
  Boxes own, boxes;
  for (const Vec3& x : mesh.vertices) {
    own.push_back(grid.voxel_of(x));
    boxes.emplace_back(own.back().min().array() - margin * voxel, own.back().max().array() + margin * voxel);
  }
  const std::vector<Vec3> at_first = mesh.vertices;
  const std::vector<Vec3> normals = project_to_surface(mesh.vertices, function, voxel, boxes);
  const Rings rings = rings_of(mesh);
  constexpr double sharp = 0.8;  // cosine of the angle between normals of neighbours, above which the surface is smooth
  std::vector<Vec3> moved = mesh.vertices;
  tbb::parallel_for(size_t{0}, moved.size(), [&](size_t i) {
    bool sharp_edge = false;
    for (int k = rings.first[i]; k < rings.first[i + 1] && !sharp_edge; ++k) sharp_edge = normals[rings.list[k]].dot(normals[i]) < sharp;
    if (sharp_edge) moved[i] = crease_position(static_cast<int>(i), mesh, rings, normals, own[i]);
  });
  std::swap(mesh.vertices, moved);
  undo_crossings(mesh, moved, at_first);
  flip_slivers(mesh, 0.02 * voxel);  // along creases, three vertices may be collinear
  return mesh;
}

}  // namespace tack
