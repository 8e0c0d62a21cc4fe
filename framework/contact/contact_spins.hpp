// The rotation of rods and particles as friction feels it (`rolling: true`). A rod of contact
// offset R turns about its tangent t, by the arc u = r theta of each edge (rod/rod_frames.hpp); a
// particle has three arcs at its radius of gyration r, one for each axis of space. With the unit
// normal n from the opposite side to the point of contact, a rotation w of either side adds
//     R n x w
// to the slip: the material at the contact lies R before the axis. Each number has a direction,
//     (R / r) n x t  of a rod,    (R / r) n x e_k  of a particle,
// by which a change of the number moves the point of contact as seen from the other side.
//     Limits:
//  * The lever is the contact offset without the gap beside it. The moment of friction over the gap
//    is left out, as between all surfaces.
//  * A rod does not tilt by friction along it.
//  * Vertices where more than two edges meet do not turn.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "geometry/types.hpp"

namespace tack {

class ContactSpins {
 public:
  // Numbers (their vertices in x) and their directions, each number once.
  struct Columns {
    static constexpr int capacity = 6;
    std::array<int, capacity> numbers;
    std::array<Vec3, capacity> directions;
    int count = 0;
    void add(int number, const Vec3& direction);
  };

  explicit ContactSpins(int vertices = 0)
      : particle_(vertices, {-1, -1, -1}), lever_(vertices, 0), rods_(vertices) {}

  // arcs: the numbers for the axes x, y, z. lever: R / r.
  void add_particle(int vertex, const std::array<int, 3>& arcs, double lever);
  void add_rod(const Edge& edge, int arc, double lever);

  bool empty() const { return !any_; }
  // Appends the columns of a vertex, an edge or a triangle in contact, by its vertices; x: 3n [m].
  void append(std::span<const int> vertices, const Vec3& normal, const VecX& x,
              Columns& columns) const;

 private:
  struct RodEdge {
    int other, arc;
    double lever;  // negative at the second vertex of the edge, so that both see one tangent
  };

  bool any_ = false;
  std::vector<std::array<int, 3>> particle_;  // per vertex; -1: it is none
  std::vector<double> lever_;                 // per vertex, of particles
  std::vector<std::vector<RodEdge>> rods_;    // per vertex
};

}  // namespace tack
