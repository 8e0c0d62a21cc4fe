// Which part of a surface lies opposite another one, at the start of a step.
// A triangle is covered by an object if each of its corners sees a piece of it that the triangle faces, and does
// not lie beyond that piece's rim: a crease or the boundary of a sheet. Covered triangles give their area to
// their corners. Where the rim runs across a triangle, or it is so large that only its inside is opposite, it is
// divided and cut along the rim, and what is covered of it is represented by points inside (samples). So the area that adheres is the
// overlap, whatever the meshes, and what only comes near a rim from beside does not count.
#pragma once

#include <vector>

#include "framework/contact/covered_parts.hpp"
#include "framework/contact/point_pieces.hpp"
#include "geometry/broad_phase/broad_phase.hpp"

namespace tack {

// A quadrature point inside a triangle.
struct ContactSample {
  int triangle;
  Vec3 inside;   // its barycentric coordinates
  int object;    // opposite
  Vec3 normal;   // unit, of what is opposite, towards the point
  double area;   // towards that [m^2]
};

class Coverage {
 public:
  Coverage(const ContactSurface& surface, const PairTable& pairs, const HeldSurface& held);

  // The area and points that each side has in covered triangles, for the pairs that choose by it.
  void capture(const std::vector<GroupView>& views, IntegrationSides& sides) const;
  // Sets the areas of the views of pairs that want it to what is covered, and makes their samples.
  void weigh(const IntegrationSides& sides, const BroadPhase& broad_phase, std::vector<GroupView>& views);

  const std::vector<ContactSample>& samples() const { return samples_; }
  // What those areas are made of, of each pair that has any.
  const std::vector<CoveredParts>& parts() const { return parts_; }
  bool wanted() const { return wanted_; }  // whether any pair wants weights

 private:
  struct Corner {
    int view, piece;  // that the triangle faces most
  };
  struct Found;
  struct Opposite;
  struct Chunk;
  std::array<Corner, 3> corners(const std::vector<GroupView>& views, int triangle, int object) const;
  bool covered(const std::vector<GroupView>& views, int triangle, const std::array<Corner, 3>& corners) const;
  bool may_face(int triangle, int other) const;
  bool weighs(int a, int b, const IntegrationSides& sides) const;
  // Ordered pairs of objects that want weights, integrate and may be near, ascending.
  std::vector<std::array<int, 2>> near_objects(const IntegrationSides& sides, const std::vector<Aabb>& boxes) const;
  std::vector<Aabb> object_boxes() const;
  void weigh_chunk(const Chunk& chunk, const BroadPhase& broad_phase, const std::vector<GroupView>& views) const;
  void take_covered(int triangle, double reach, bool bonds, const std::array<Corner, 3>& at, const std::vector<GroupView>& views,
                    Found& found) const;

  const ContactSurface& surface_;
  const PairTable& pairs_;
  const HeldSurface& held_;
  std::vector<int> first_triangle_;  // of each object, and the end
  bool wanted_;
  std::vector<ContactSample> samples_;
  std::vector<CoveredParts> parts_;
};

}  // namespace tack
