// Optimisation of the position of a point inside a polyhedron: each face makes a tet with it.
#pragma once

#include "geometry/tets/tet_editor.hpp"

namespace tack {

class TetStar {
 public:
  // faces: counter-clockwise from inside.
  TetStar(const TetEditor& mesh, std::vector<Triangle> faces)
      : mesh_(mesh), faces_(std::move(faces)) {}

  double worst_at(const Vec3& position) const;  // lowest quality of its tets
  // Moves a position while that improves the worst tet.
  void improve(Vec3& position) const;
  std::vector<Tet> tets(int centre) const;

 private:
  bool step(Vec3& position) const;

  const TetEditor& mesh_;
  std::vector<Triangle> faces_;
};

}  // namespace tack
