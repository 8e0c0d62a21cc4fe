// Whether the barrier took much of what curved bodies were pressed together by. Where curved elastic surfaces meet, as in Hertz' contact, how far
// they approach each other decides on the force, and on the area that touches. In a barrier they do so by a part of contact.distance
// before they carry the same pressure: as if both were softer. How much that is, against what the surfaces gave way by, the run alone knows:
//  * the barrier's approach: the mean of contact.distance less the gap, weighted with the force;
//  * that of the surfaces: 7.6 times by how much they lost of their shape towards each other where they press, root of the mean square. Of a
//    sphere of radius R in contact over a radius a that is the height (a^2 / 2 R) (r / a)^2 over its best plane, and a^2 / R its approach.
// That is a result where forces are in balance, in quasi-static runs: what moves is led by its inertia, and touches many things by next to nothing.
// Surfaces that are flat where they meet are not looked at, whatever the barrier does: it shifts them, and changes no force. Neither is
// what adheres, for which the law between surfaces is stated, nor what has no tets, or too few points in contact to have a shape.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "geometry/types.hpp"

namespace tack {

struct SceneConfig;
struct World;

// A place where two surfaces press each other: on each, at rest and now [m], and how much [N].
struct PressedPoint {
  std::array<Vec3, 2> rest, now;
  double force;
};

// All weighted with the forces. Heights are those over the plane nearest to all points of a surface, at rest or now.
struct PressedZone {
  double gap = 0;        // the mean of it now [m]
  double curved = 0;     // of the one surface at rest over the other, root of the mean square [m]; 0: flat, or not known
  double flattened = 0;  // by how much that has changed [m]
};
PressedZone pressed_zone(const std::vector<PressedPoint>& points);

class ContactApproach {
 public:
  ContactApproach(const SceneConfig& scene, const World& world);

  // At the end of a step, at x (3n), where contact is.
  void look(const VecX& x);
  // What to tell in the end: of each two objects, of when they pressed each other most.
  std::vector<std::string> soft() const;

 private:
  using Objects = std::pair<int, int>;  // ascending
  struct Pressed {
    double force = 0;                // N
    double barrier = 0, elastic = 0;  // approach [m]
    double distance = 0;             // in which the barrier acts [m]
  };
  bool looked_at(const Objects& objects) const;
  std::map<Objects, std::vector<PressedPoint>> zones(const VecX& x) const;

  const SceneConfig& scene_;
  const World& world_;
  std::vector<char> soft_, firm_;  // per object: elastic tets; what keeps the shape of its surface
  std::vector<char> wanted_;       // per law: it does not adhere; empty: nobody is soft
  std::map<Objects, Pressed> pressed_;
};

}  // namespace tack
