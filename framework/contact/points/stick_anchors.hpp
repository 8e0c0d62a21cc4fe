// Anchors of sticking friction (friction `model: stick`): the elastic slip of contact points from
// step to step. Friction is Coulomb's law with an elastic tangential spring and a return mapping
// (Wriggers 2006, Computational Contact Mechanics, chapters 5 and 10; the spring's stiffness is
// proportional to the normal force, as that of Abaqus, "allowable elastic slip").
//
// A contact point k with the coefficients c has at x the vector r = sum_i c_i x_i from the opposite
// point to the point. With the frame M of a triangle beside the contact, which turns with it, and
// constant components w,
//     E = r - M w                        elastic slip, a vector along the surface [m]
// is the displacement of the point against its anchor. A step begins with the elastic slip e = T^T
// E of each contact point (tangents T), and friction depends on u = e + T^T sum_i c_i (x_i -
// x_i^n). At its end the return mapping moves the anchor: |u| is cut to the elastic slip l of the
// law. So a point at rest keeps its anchor to the bit, and no rotation of both sides moves it.
//
// The contact points of a step are not those of the step before. A new one takes the elastic slip
// of the closest stored one that shares a vertex of its own side, is between the same objects, and
// whose normal agrees (dot > 0); one of the same vertices on both sides precedes. Without one it is
// 0.
// Limits: two sides without triangles (rods, particles) have no frame, M = I. If both turn by an
// angle while they stick, they slip by the gap times that angle.
#pragma once

#include <array>
#include <vector>

#include "framework/contact/points/contact_points.hpp"
#include "framework/contact/surface/surface_topology.hpp"
#include "framework/core/history.hpp"

namespace tack {

class StickAnchors {
 public:
  // Name of the array in a history. It holds indices of vertices.
  static constexpr const char* history_name = "contact/stick anchors";

  // Whether any law of the table sticks.
  static bool any(const PairTable& pairs);

  void read(const History& history);
  // Sets the elastic slips of the points whose laws stick, `elastic`, for a step that begins at x.
  void assign(const PairTable& pairs, const VecX& x, ContactPoints& points) const;
  // Writes the anchors after the step from `start` to x with these points.
  static void write(const ContactPoints& points, const PairTable& pairs,
                    const SurfaceTopology& topology, const CollisionMesh& mesh, const VecX& start,
                    const VecX& x, History& history);

 private:
  static constexpr int most = largest_contact_arity;
  struct Anchor {
    int count, own_count;  // vertices, and those of the point
    std::array<int, most> vertices;
    std::array<double, most> c;
    std::array<int, 3> triangle;  // vertices of the frame's triangle; -1: M = I
    Vec3 w;                       // m
    int object, opposite;
  };
  struct Placed;  // an anchor at the start of a step

  std::vector<Anchor> anchors_;  // ascending by (first vertex, opposite object)
};

}  // namespace tack
