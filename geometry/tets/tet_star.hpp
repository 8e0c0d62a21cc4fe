// A point and the faces around it, each of which makes a tet with it: where such a point is best.
#pragma once

#include "geometry/tets/tet_editor.hpp"

namespace tack {

class TetStar {
 public:
  // Faces that are counterclockwise as seen from within.
  TetStar(const TetEditor& mesh, std::vector<Triangle> faces)
      : mesh_(mesh), faces_(std::move(faces)) {}

  double worst_at(const Vec3& place) const;  // the lowest quality of its tets
  // Moves a place to where the worst tet is better, as far as that goes on.
  void climb(Vec3& place) const;
  std::vector<Tet> tets(int centre) const;

 private:
  bool step(Vec3& place) const;

  const TetEditor& mesh_;
  std::vector<Triangle> faces_;
};

}  // namespace tack
