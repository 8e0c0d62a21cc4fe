// All prescribed motions of a scene, by vertex and time span.
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
  struct Assignment {
    const Motion* motion;
    std::vector<int> vertices;  // global, ascending
    std::string name;           // for messages: "motion 0 (fixed) of 'plate'"
  };

  PrescribedMotion() = default;
  explicit PrescribedMotion(int vertex_count)
      : ever_fixed_(vertex_count, 0), ever_free_(vertex_count, 1), moves_(vertex_count, 0),
        rigid_group_(vertex_count, -1) {}

  void grow(int more);  // vertices, behind the others

  // Throws InputError if another motion fixes one of the vertices at the same time, unless both fix
  // directions that are orthogonal to each other.
  void add(Assignment assignment);
  // Once all motions are there: the vertex follows others, and is free, or moved, where one of them
  // is.
  void follow(const Dependence& dependence);
  // Fixes directions of a vertex for the whole run: those of a scalar dof (unknowns.hpp).
  void fix_always(const HeldDirections& held) { always_fixed_.push_back(held); }
  const std::vector<HeldDirections>& always_fixed() const { return always_fixed_; }
  const std::vector<Assignment>& assignments() const { return assignments_; }
  int vertex_count() const { return static_cast<int>(ever_free_.size()); }

  // Return the motions active at time t [s], and the vertices that are free in some direction.
  std::vector<char> active(double t) const;
  std::vector<char> free(const std::vector<char>& active) const;
  // Returns the vertices of which active motions fix some directions.
  std::vector<HeldDirections> fixed_directions(const std::vector<char>& active) const;
  // Writes the positions prescribed by active motions at time t into x; anchor, rest: 3n [m].
  void place(const std::vector<char>& active, const VecX& rest, const VecX& anchor, double t,
             VecX& x) const;

  bool ever_fixed(int v) const { return ever_fixed_[v]; }
  bool moves(int v) const { return moves_[v]; }  // some hold moves it
  bool ever_free(int v) const { return ever_free_[v]; }
  // Returns true if the vertex may ever leave its initial position.
  bool may_move(int v) const { return ever_free_[v] || moves_[v]; }
  // Vertices of one group (>= 0) never move against each other, throughout the run; -1: no such
  // group.
  int rigid_group(int v) const { return rigid_group_[v]; }

 private:
  static void place(const Assignment& assignment, const VecX& rest, const VecX& anchor, double t, VecX& x);

  std::vector<Assignment> assignments_;
  std::vector<HeldDirections> always_fixed_;
  std::vector<char> ever_fixed_, ever_free_, moves_;
  std::vector<int> rigid_group_;
  // s: of vertices that are held whole for a while
  std::map<int, std::vector<std::pair<double, double>>> fixed_spans_;
};

}  // namespace tack
