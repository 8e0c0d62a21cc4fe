// Prescribed motion of a scene: all motions, by vertex and time span.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "framework/core/dof_map.hpp"
#include "framework/motion/motion.hpp"

namespace tack {

class PrescribedMotion {
 public:
  // A motion and the vertices that it moves.
  struct Assignment {
    const Motion* motion;
    std::vector<int> vertices;  // global, ascending
    std::string name;           // for messages: "motion 0 (fixed) of 'plate'"
  };

  PrescribedMotion() = default;
  explicit PrescribedMotion(int vertex_count)
      : ever_fixed_(vertex_count, 0), ever_free_(vertex_count, 1), moves_(vertex_count, 0),
        rigid_group_(vertex_count, -1) {}

  // Appends `count` vertices without motion.
  void add_vertices(int count);

  // Throws InputError if another motion fixes one of the vertices at the same time, unless both fix
  // directions that are orthogonal to each other.
  void add(Assignment assignment);
  // Makes a vertex dependent: it is free, or moved, if one of the vertices that it depends on is.
  // To be called after all motions are added.
  void add_dependence(const Dependence& dependence);
  // Fixes directions of a vertex for the whole run, e.g. those of a scalar dof (unknowns.hpp).
  void fix_always(const FixedDirections& fixed) { always_fixed_.push_back(fixed); }
  const std::vector<FixedDirections>& always_fixed() const { return always_fixed_; }
  const std::vector<Assignment>& assignments() const { return assignments_; }
  int vertex_count() const { return static_cast<int>(ever_free_.size()); }

  // Returns a flag per motion: whether it is active at time t [s].
  std::vector<char> active(double t) const;
  // Returns a flag per vertex: whether it is free in some direction.
  std::vector<char> free(const std::vector<char>& active) const;
  // Returns the vertices with fixed directions under the active motions.
  std::vector<FixedDirections> fixed_directions(const std::vector<char>& active) const;
  // Writes the positions prescribed by active motions at time t into x; reference, rest: 3n [m].
  void set_positions(const std::vector<char>& active, const VecX& rest, const VecX& reference,
                     double t, VecX& x) const;

  // Returns whether a motion ever fixes the vertex, in some direction at least.
  bool ever_fixed(int v) const { return ever_fixed_[v]; }
  // Returns whether a motion ever moves the vertex.
  bool moves(int v) const { return moves_[v]; }
  // Returns whether the vertex is ever free.
  bool ever_free(int v) const { return ever_free_[v]; }
  // Returns true if the vertex may ever leave its initial position.
  bool may_move(int v) const { return ever_free_[v] || moves_[v]; }
  // Returns the rigid group of a vertex; -1: none. Vertices of one group keep their distances
  // throughout the run.
  int rigid_group(int v) const { return rigid_group_[v]; }

 private:
  static void set_positions(const Assignment& assignment, const VecX& rest, const VecX& reference,
                            double t, VecX& x);

  std::vector<Assignment> assignments_;
  std::vector<FixedDirections> always_fixed_;
  std::vector<char> ever_fixed_, ever_free_, moves_;
  std::vector<int> rigid_group_;
  // Time spans [s] of vertices that are fixed in all directions for a part of the run.
  std::map<int, std::vector<std::pair<double, double>>> fixed_spans_;
};

}  // namespace tack
