// Overlap depth of two surfaces, and the direction that separates them. Lengths in metres.
//
// A closed surface has a signed distance, negative inside: the distance to the closest triangle,
// with the sign of the angle-weighted normal there (Baerentzen and Aanaes 2005). It needs no grid.
// An open surface has an unsigned distance.
#pragma once

#include <optional>
#include <vector>

#include "geometry/broad_phase/bvh.hpp"
#include "geometry/mesh/mesh.hpp"

namespace tack {

class SurfaceDistance {
 public:
  explicit SurfaceDistance(const Mesh& mesh);

  struct Closest {
    double distance;  // negative inside of a closed surface
    Vec3 away;        // unit gradient
  };
  // Returns none if the surface is farther than `range`, or for a point on an open surface.
  std::optional<Closest> at(const Vec3& x, double range) const;

  const Aabb& box() const { return box_; }
  bool closed() const { return closed_; }
  // Volume [m^3]; for an open surface, edges and points: volume of a ball of its extent.
  double volume() const { return volume_; }
  // Appends points of the surface within a box: vertices, and points of edges and triangles that
  // are longer than the spacing.
  struct Sample {
    Vec3 at, normal;  // outwards, of any length; zero on an open surface
  };
  void sample(const Aabb& box, double spacing, std::vector<Sample>& samples) const;
  Vec3 middle() const { return 0.5 * (box_.lo + box_.hi); }

 private:
  std::optional<Closest> within(const Vec3& x, double range) const;

  std::vector<Vec3> vertices_;  // all vertices of the mesh
  std::vector<int> used_;
  std::vector<Edge> edges_;
  std::vector<Vec3> edge_;  // per edge: sum of the normals of its triangles
  std::vector<Triangle> triangles_;
  // Unit normals of triangles; angle-weighted normals of vertices.
  std::vector<Vec3> face_, corner_;
  std::vector<std::array<Vec3, 3>> side_;  // per triangle: normals of its edges
  Bvh tree_;
  Aabb box_;
  bool closed_ = false;
  double volume_ = 0;
};

// Only points of one surface inside the other count whose normal is against the exit direction:
// past the medial surface, the exit direction leads deeper. Without such points, the surfaces
// separate along the line between their centres.
struct OverlapDepth {
  double distance;  // smallest distance; negative: overlap depth
  Vec3 at;          // point of the smallest distance
  Vec3 away;        // unit direction in which the first surface has to move
};

// Returns the overlap depth of two surfaces, translated by a and b; none if their distance is at
// least `range`, or the overlap deeper than `deepest` [m].
std::optional<OverlapDepth> overlap_depth(const SurfaceDistance& first, const Vec3& a,
                                          const SurfaceDistance& second, const Vec3& b,
                                          double range, double deepest);

}  // namespace tack
