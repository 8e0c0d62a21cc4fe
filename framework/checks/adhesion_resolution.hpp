// Warnings about adhesion on elements that are too large for it. A traction sampled at points is
// integrated well only if the gap hardly changes from one point to the next. Across an element of
// size h, whose face is at an angle theta to the other surface, the gap changes by h sin(theta).
// The limit is a quarter of the range. Plates tilted by 5 degrees pull with this fraction of the
// exact force, depending on the positions of their vertices:
//     gap change across a cell   range / 2: 0.81 to 1.21    range / 4: 0.95 to 1.08
// Tips of ridges that cross between two vertices do not pull at all. Only the run shows this,
// unlike the curvature of a surface (resolution.hpp).
#pragma once

#include <string>
#include <vector>

#include "framework/core/warning.hpp"
#include "geometry/types.hpp"

namespace tack {

struct SceneConfig;
struct World;

class AdhesionResolution {
 public:
  AdhesionResolution(const SceneConfig& scene, const World& world);

  // Examines the end of a step of size h [s] at x (3n), where contact must be.
  void examine(const VecX& x, double h);
  // Returns a warning for each law that applied more than half of its impulse on too large
  // elements.
  std::vector<Warning> warnings() const;

 private:
  struct LawImpulse {
    double all = 0, coarse = 0;   // N s
    double size = 0;              // N s m: coarse impulse times sufficient size
    int object = -1, other = -1;  // the first pair with it
  };
  struct Element {
    double gap_change = 0, size = 0;  // m
  };
  Element element_at(int vertex, const Vec3& n, const VecX& x) const;
  static Element element_around(const Triangle& triangle, const Vec3& n, double own_area,
                                const VecX& x);
  void add(int law, double impulse, const Element& element, int object, int other);

  const SceneConfig& scene_;
  const World& world_;
  std::vector<char> adheres_;         // per law
  std::vector<LawImpulse> impulses_;  // per law
};

}  // namespace tack
