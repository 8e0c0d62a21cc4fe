// Which part of a surface lies opposite another one, at the start of a step.
// A triangle is covered by an object if each of its corners sees a piece of it that the triangle faces, and does
// not lie beyond that piece's rim: a crease or the boundary of a sheet. Covered triangles give their area to
// their corners, if they are small or the gap is even. Where the rim runs across a triangle, or it is so large that only its inside is opposite, it is
// divided and cut along the rim, and what is covered of it is represented by points inside (samples). So the area that adheres is the
// overlap, whatever the meshes, and what only comes near a rim from beside does not count.
// Where other laws hold between parts of the two (pair_table.hpp), what a triangle faces is taken part by part, unless one law holds for all of it and for what
// its corners stand for.
// What is out of range when the step begins exerts no force then, and most of it none in the whole step. So such triangles wait: each is
// divided, as the step found it, as soon as it may have come within range, and likewise each part of it of which one sample is made.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "framework/contact/covered_parts.hpp"
#include "framework/contact/part_of_surface.hpp"
#include "framework/contact/point_pieces.hpp"
#include "geometry/broad_phase/broad_phase.hpp"

namespace tack {

class TriangleDivision;

// A quadrature point inside a triangle.
struct ContactSample {
  int triangle;
  Vec3 inside;   // its barycentric coordinates
  int object;    // opposite
  Vec3 normal;   // unit, of what is opposite, towards the point
  double area;   // towards that [m^2]
  int cell;      // of the triangle, which it stands for
  int part;      // of what is opposite, by the laws that hold (PairTable::part)
};

class Coverage {
 public:
  Coverage(const ContactSurface& surface, const PairTable& pairs, const HeldSurface& held);

  // The area and points that each side has in covered triangles, for the pairs that choose by it.
  void capture(const std::vector<GroupView>& views, IntegrationSides& sides) const;
  // Sets the areas of the views of pairs that want it to what is covered, and makes their samples.
  void weigh(const IntegrationSides& sides, const BroadPhase& broad_phase, std::vector<GroupView>& views);

  // Divides the triangles that wait and may be within range at x. The numbers of their samples, ascending; others keep their order.
  std::vector<int> approach(const VecX& x);

  // By object, object opposite, triangle, cell and part.
  const std::vector<ContactSample>& samples() const { return samples_; }
  // What those areas are made of, of each pair that has any.
  const std::vector<CoveredParts>& parts() const { return parts_; }
  bool wanted() const { return wanted_; }  // whether any pair wants weights
  // The area of a vertex towards a normal, of triangles of which it was not found, when the step began, what lies opposite them of an object: of those that
  // came from farther away than twice the range. What is covered of others has been given out, to other points than those that see it later.
  double unknown_area(int vertex_index, int object, const Vec3& normal) const;
  // Whether views of an object of such a vertex have those areas.
  bool weighs(int a, int b, const IntegrationSides& sides) const;

 private:
  struct Corner {
    int view, piece;  // that the triangle faces most
  };
  // A triangle, or a cell of it, with what is within reach of the triangle of an object, all of which is out of range. What is farther than
  // that is out of range by as much as the range at least.
  struct Waiting {
    int triangle, object;
    int depth, cell;  // triangle_division.hpp
    int begin, end;  // into around_
    double away;     // by so much [m]
    int part = -1;   // of the object, if it is a cell
  };
  // Those that wait of one object for another one.
  struct WaitingPair {
    int a, b, begin, end;  // into waiting_
    double away;           // all of them at least [m]
  };
  // What is within reach of a triangle, of one object.
  struct Around {
    std::vector<int> triangles;
    double nearest;  // m
    bool parallel;   // all that it may face
    bool faced;      // there is such
  };
  // What a triangle faces of an object, and to which the same laws hold; no part: all that it faces.
  struct FacedPart {
    std::optional<PartOfSurface> part;
    std::vector<int> triangles;
    const PartOfSurface* seen() const { return part ? &*part : nullptr; }
    int number() const { return part ? part->part() : -1; }
  };
  // Triangles of one object of which it was found what lies opposite them of another one.
  struct KnownPair {
    int a, b;
    std::vector<int> triangles;  // ascending
  };
  struct Found;
  struct Opposite;
  struct Chunk;
  class Moves;
  std::array<Corner, 3> corners(const std::vector<GroupView>& views, int triangle, int object) const;
  bool covered(const std::vector<GroupView>& views, int triangle, const std::array<Corner, 3>& corners) const;
  bool even_gap(int triangle, const std::array<Corner, 3>& at, const std::vector<GroupView>& views, double range) const;
  bool one_law(const std::vector<GroupView>& views, int triangle, int object, const std::array<Corner, 3>& at) const;
  bool may_face(int triangle, int other) const;
  // Ordered pairs of objects that want weights, integrate and may be near, ascending.
  std::vector<std::array<int, 2>> near_objects(const IntegrationSides& sides, const std::vector<Aabb>& boxes) const;
  std::vector<Aabb> object_boxes() const;
  void weigh_chunk(const Chunk& chunk, const BroadPhase& broad_phase, const std::vector<GroupView>& views) const;
  Around find_around(int triangle, int object, const std::vector<int>& near) const;
  void divide_or_wait(int triangle, int object, const Around& around, TriangleDivision& division, Found& found) const;
  std::vector<int> facing(int triangle, std::span<const int> others) const;
  std::vector<FacedPart> faced_parts(int triangle, int object, std::span<const int> others) const;
  std::vector<int> divide(const std::vector<int>& numbers);
  void add_waiting(int a, int b, std::span<const Waiting> some, const std::vector<int>& around);
  std::vector<int> insert(std::vector<ContactSample>& added);
  void take_covered(int triangle, double reach, bool bonds, const std::array<Corner, 3>& at, const std::vector<GroupView>& views,
                    Found& found) const;

  const ContactSurface& surface_;
  const PairTable& pairs_;
  const HeldSurface& held_;
  std::vector<int> first_triangle_;  // of each object, and the end
  bool wanted_;
  std::vector<ContactSample> samples_;
  std::vector<CoveredParts> parts_;
  std::vector<KnownPair> known_;  // by pair
  std::vector<WaitingPair> waiting_pairs_;
  std::vector<Waiting> waiting_;
  std::vector<int> around_;  // triangles
};

}  // namespace tack
