// Overlap depth of two surfaces, and the direction that separates them. Lengths in metres.
//
// A surface that encloses a volume has a signed distance, negative inside: that to the closest
// triangle, with the sign of the angle-weighted normal there (Baerentzen and Aanaes 2005); it needs
// no grid. One that is open has a distance without a sign.
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
  // Returns none if nothing is within `reach`, or for a point on an open surface.
  std::optional<Closest> at(const Vec3& x, double reach) const;

  const Aabb& box() const { return box_; }
  bool closed() const { return closed_; }
  // m^3; of an open surface, edges and points: that of a ball of its extent.
  double volume() const { return volume_; }
  // Returns its points within a box: vertices, and points of edges and triangles that are longer
  // than the spacing.
  struct Sample {
    Vec3 at, normal;  // outwards, of any length; zero on an open surface
  };
  void sample(const Aabb& box, double spacing, std::vector<Sample>& samples) const;
  Vec3 middle() const { return 0.5 * (box_.lo + box_.hi); }

 private:
  std::optional<Closest> within(const Vec3& x, double reach) const;

  std::vector<Vec3> vertices_;  // of the mesh
  std::vector<int> used_;
  std::vector<Edge> edges_;
  std::vector<Vec3> edge_;  // of each, the normals of its triangles, summed
  std::vector<Triangle> triangles_;
  // Unit normals of triangles; angle-weighted ones of vertices.
  std::vector<Vec3> face_, corner_;
  std::vector<std::array<Vec3, 3>> side_;          // per triangle, of its edges
  Bvh tree_;
  Aabb box_;
  bool closed_ = false;
  double volume_ = 0;
};

// Counts those points of one surface in the other whose normal faces the exit direction: past the
// medial surface the exit direction leads deeper. Without such points, the surfaces separate along
// the line between their centres.
struct OverlapDepth {
  double distance;  // smallest distance; negative: overlap depth
  Vec3 at;          // there
  Vec3 away;        // unit: where the first one has to go
};

// Returns the overlap depth of two surfaces, moved by a and b; none if their distance is at least
// `reach`, or the overlap too deep.
std::optional<OverlapDepth> overlap_depth(const SurfaceDistance& first, const Vec3& a,
                                          const SurfaceDistance& second, const Vec3& b,
                                          double reach, double deepest);

}  // namespace tack
