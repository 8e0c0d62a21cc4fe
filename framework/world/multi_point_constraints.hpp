// Multi-point constraints of a scene: dependent vertices that follow independent ones, and the
// times at which they do (core/dependence.hpp).
#pragma once

#include <array>
#include <string>
#include <vector>

#include "framework/core/dependence.hpp"
#include "framework/world/joint.hpp"

namespace tack {

// Frame of an affine body: four independent vertices. All other vertices of the body are weighted
// sums of them; the weights of each add up to one.
struct AffineFrame {
  std::array<int, 4> frame;
  struct Dependent {
    int vertex;
    std::array<double, 4> weights;
  };
  std::vector<Dependent> dependents;
};

// Constraint for an interval of time: vertices of one object depend on those of another.
struct TimedConstraint {
  std::string name;  // for messages: "attach 0 of 'box'"
  Dependences dependences;
  double from = 0, until = 0;  // s
};

class MultiPointConstraints {
 public:
  void add(AffineFrame frame) { frames_.push_back(std::move(frame)); }
  // Adds a dependent vertex of the frame with this first vertex.
  void add_dependent(int first_of_frame, const AffineFrame::Dependent& dependent);
  void add(TimedConstraint constraint) { timed_.push_back(std::move(constraint)); }
  void add_lasting(Dependence dependence) { lasting_.push_back(std::move(dependence)); }
  void add(Joint joint) { joints_.push_back(std::move(joint)); }

  const std::vector<AffineFrame>& frames() const { return frames_; }
  const std::vector<TimedConstraint>& timed() const { return timed_; }
  const Dependences& lasting() const { return lasting_; }
  const std::vector<Joint>& joints() const { return joints_; }
  // Joints connect frames, so that they are not counted here.
  bool empty() const { return frames_.empty() && timed_.empty() && lasting_.empty(); }

  // Returns a flag per timed constraint: whether it acts at time t [s].
  std::vector<char> active(double t) const;
  // Returns all dependences with the active timed constraints and with vertices fixed where
  // free[v] == 0. If n affinely independent vertices of an affine body are fixed or dependent on
  // another object, n vertices of its frame become dependent: one for a vertex, two for a line,
  // three for a plane. free may be empty if there are no joints: no vertex is fixed.
  Dependences at(const std::vector<char>& free, const std::vector<char>& active_timed) const;
  // Returns the dependences of at() without joints.
  Dependences unjoined_at(const std::vector<char>& free,
                          const std::vector<char>& active_timed) const;

 private:
  std::vector<AffineFrame> frames_;
  std::vector<TimedConstraint> timed_;
  Dependences lasting_;
  std::vector<Joint> joints_;
};

}  // namespace tack
