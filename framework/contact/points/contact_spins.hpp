// Rotation of rods and particles by friction (`rolling: true`). A rod of contact offset R turns
// about its tangent t by the arc u = r theta of each edge (rod/rod_frames.hpp). A particle has
// three arcs at its radius of gyration r, one for each axis of space. With the unit normal n from
// the opposite side to the contact point, a rotation w of either side adds
//     R n x w
// to the slip: the material at the contact lies R before the axis. Each arc is a scalar dof with
// the direction
//     (R / r) n x t  of a rod,    (R / r) n x e_k  of a particle,
// by which a change of the dof moves the contact point relative to the other side.
//     Limits:
//  * The lever is the contact offset without the gap. The moment of friction over the gap is left
//    out, as between all surfaces.
//  * Friction along a rod does not tilt it.
//  * Vertices where more than two edges meet do not turn.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "geometry/types.hpp"

namespace tack {

class ContactSpins {
 public:
  // Scalar dofs (as vertices in x) and their directions, each dof once.
  struct Columns {
    static constexpr int capacity = 6;
    std::array<int, capacity> scalar_dofs;
    std::array<Vec3, capacity> directions;
    int count = 0;
    void add(int scalar_dof, const Vec3& direction);
  };

  explicit ContactSpins(int vertices = 0)
      : particle_(vertices, {-1, -1, -1}), lever_(vertices, 0), rods_(vertices) {}

  // arcs: the scalar dofs for the axes x, y, z. lever: R / r.
  void add_particle(int vertex, const std::array<int, 3>& arcs, double lever);
  void add_rod(const Edge& edge, int arc, double lever);

  bool empty() const { return !any_; }
  // Appends the dofs of a vertex or an edge in contact, by its vertices; a triangle has none.
  // x: 3n [m].
  void append(std::span<const int> vertices, const Vec3& normal, const VecX& x,
              Columns& columns) const;

 private:
  struct RodEdge {
    int other, arc;
    double lever;  // negative at the second vertex of the edge, so that both have one tangent
  };

  bool any_ = false;
  std::vector<std::array<int, 3>> particle_;  // arcs per vertex; -1: no particle
  std::vector<double> lever_;                 // per vertex, of particles
  std::vector<std::vector<RodEdge>> rods_;    // per vertex
};

}  // namespace tack
