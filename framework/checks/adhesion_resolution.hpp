// Whether adhesion acted where elements are too large for it: a traction that is known at points is integrated well only if the gap hardly
// changes from one point to the next. Across an element of size h whose face and the way to the other surface enclose an angle theta, it
// changes by h sin(theta). More than a quarter of the range is too much: plates that are tilted by 5 degrees, with cells of half a range over
// tan(5 degrees), pull with 0.81 to 1.21 of what they should, depending on where their vertices happen to be (at a quarter: 0.95 to 1.08); the tips of ridges that
// cross, between two vertices, do not pull at all. Unlike the curvature of a surface (resolution.hpp) that is known from the run alone.
#pragma once

#include <string>
#include <vector>

#include "geometry/types.hpp"

namespace tack {

struct SceneConfig;
struct World;

class AdhesionResolution {
 public:
  AdhesionResolution(const SceneConfig& scene, const World& world);

  // At the end of a step of size h [s], at x (3n), where contact is.
  void look(const VecX& x, double h);
  // What to tell in the end: of each law, if more than half of what it pulled with was where elements are too large.
  std::vector<std::string> coarse() const;

 private:
  struct Pulled {
    double all = 0, coarse = 0;  // N s
    double size = 0;             // N s m: of what is coarse, times the size that would do
    int object = -1, other = -1;  // the first of which that was seen
  };
  struct Element {
    double gap_change = 0, size = 0;  // m
  };
  Element element_at(int vertex, const Vec3& n, const VecX& x) const;
  static Element element_around(const Triangle& triangle, const Vec3& n, double own_area, const VecX& x);
  void add(int law, double impulse, const Element& element, int object, int other);

  const SceneConfig& scene_;
  const World& world_;
  std::vector<char> adheres_;   // per law
  std::vector<Pulled> pulled_;  // per law
};

}  // namespace tack
