// Warnings about barriers that took much of the approach of curved bodies. Where curved elastic
// surfaces meet, as in Hertz contact, their approach determines the force and the contact area. A
// barrier approaches by a fraction of contact.distance before it carries the pressure, as if both
// bodies were softer. Only the run shows the fraction:
//  * Approach of the barrier: the mean of contact.distance less the gap, weighted with the force.
//  * Approach of the surfaces: 7.6 times the root mean square of their loss of height towards each
//    other where they press. For a sphere of radius R in contact over a radius a, the height over
//    the best plane is (a^2 / 2 R) (r / a)^2, and the approach is a^2 / R.
// Valid where forces balance, in quasi-static runs: moving bodies are led by their inertia, and
// touch many others slightly. Not examined are
//  * surfaces that are flat where they meet: the barrier shifts them, and changes no force,
//  * surfaces that adhere: their law is stated between surfaces,
//  * bodies without tets, and contacts with too few points to have a shape.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "framework/core/warning.hpp"
#include "geometry/types.hpp"

namespace tack {

struct SceneConfig;
struct World;

// A point where two surfaces press: its position on each, at rest and now [m], and the force [N].
struct PressedPoint {
  std::array<Vec3, 2> rest, now;
  double force;
};

// A contact zone. Means are weighted with the forces; heights are over the best-fit plane of the
// points of a surface, at rest or now.
struct PressedZone {
  double gap = 0;        // the mean of it now [m]
  double curved = 0;     // rest height difference, root mean square [m]; 0: flat or unknown
  double flattened = 0;  // by how much that has changed [m]
};
PressedZone pressed_zone(const std::vector<PressedPoint>& points);

class ContactApproach {
 public:
  ContactApproach(const SceneConfig& scene, const World& world);

  // Examines the end of a step at x (3n), where contact must be.
  void examine(const VecX& x);
  // Returns a warning for each pair of objects, judged at the time of their largest force.
  std::vector<Warning> warnings() const;

 private:
  using Objects = std::pair<int, int>;  // ascending
  struct Pressed {
    double force = 0;                 // N
    double barrier = 0, elastic = 0;  // approach [m]
    double distance = 0;              // in which the barrier acts [m]
  };
  bool is_examined(const Objects& objects) const;
  std::map<Objects, std::vector<PressedPoint>> zones(const VecX& x) const;

  const SceneConfig& scene_;
  const World& world_;
  std::vector<char> soft_, firm_;  // per object: has elastic tets; keeps the shape of its surface
  std::vector<char> wanted_;       // per law: without adhesion; empty: no object is soft
  std::map<Objects, Pressed> pressed_;
};

}  // namespace tack
