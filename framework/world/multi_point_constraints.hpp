// Multi-point constraints of a scene: dependent vertices that follow independent ones, and the
// times at which they do (core/dependence.hpp).
#pragma once

#include <array>
#include <string>
#include <vector>

#include "framework/core/dependence.hpp"
#include "framework/world/joint.hpp"

namespace tack {

// The frame of an affine body: four independent vertices that all others follow, with weights that
// sum up to one for each.
struct AffineFrame {
  std::array<int, 4> frame;
  struct Carried {
    int vertex;
    std::array<double, 4> weights;
  };
  std::vector<Carried> carried;
};

// A tie: vertices of one object that follow another object's for an interval of time.
struct Tie {
  std::string name;  // for messages: "attach 0 of 'box'"
  Dependences dependences;
  double from = 0, until = 0;  // s
};

class MultiPointConstraints {
 public:
  void add(AffineFrame frame) { frames_.push_back(std::move(frame)); }
  // Adds a dependent vertex of the frame with this first vertex.
  void carry(int first_of_frame, const AffineFrame::Carried& carried);
  void add(Tie tie) { ties_.push_back(std::move(tie)); }
  void add_lasting(Dependence dependence) { lasting_.push_back(std::move(dependence)); }
  void add(Joint joint) { joints_.push_back(std::move(joint)); }

  const std::vector<AffineFrame>& frames() const { return frames_; }
  const std::vector<Tie>& ties() const { return ties_; }
  const Dependences& lasting() const { return lasting_; }
  const std::vector<Joint>& joints() const { return joints_; }
  // Joints are between frames.
  bool empty() const { return frames_.empty() && ties_.empty() && lasting_.empty(); }

  // Returns a flag per tie: whether it acts at time t [s].
  std::vector<char> active(double t) const;
  // Returns all constraints with these ties and with vertices fixed where free[v] == 0. Where
  // vertices of an affine body are fixed or tied, as many vertices of its frame become dependent as
  // these are affinely independent: one vertex leaves three independent, a line two, a plane one.
  // free may be empty where there are no joints: no vertex is fixed.
  Dependences at(const std::vector<char>& free, const std::vector<char>& active_ties) const;
  // Returns these constraints without joints.
  Dependences unjoined_at(const std::vector<char>& free,
                          const std::vector<char>& active_ties) const;

 private:
  std::vector<AffineFrame> frames_;
  std::vector<Tie> ties_;
  Dependences lasting_;
  std::vector<Joint> joints_;
};

}  // namespace tack
