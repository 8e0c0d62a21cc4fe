// Which vertices of a scene follow others, and when (core/dependence.hpp).
#pragma once

#include <array>
#include <string>
#include <vector>

#include "framework/core/dependence.hpp"
#include "framework/world/joint.hpp"

namespace tack {

// The four vertices that all others of an affine body follow, with weights that add up to one for each.
struct AffineFrame {
  std::array<int, 4> frame;
  struct Carried {
    int vertex;
    std::array<double, 4> weights;
  };
  std::vector<Carried> carried;
};

// Vertices of one object that follow another's, for a while.
struct Tie {
  std::string name;  // for messages: "attach 0 of 'box'"
  Dependences dependences;
  double from = 0, until = 0;  // s
};

class Bindings {
 public:
  void add(AffineFrame frame) { frames_.push_back(std::move(frame)); }
  // Another vertex that follows the frame of which that is the first one.
  void carry(int first_of_frame, const AffineFrame::Carried& carried);
  void add(Tie tie) { ties_.push_back(std::move(tie)); }
  void add_lasting(Dependence dependence) { lasting_.push_back(std::move(dependence)); }
  void add(Joint joint) { joints_.push_back(std::move(joint)); }

  const std::vector<AffineFrame>& frames() const { return frames_; }
  const std::vector<Tie>& ties() const { return ties_; }
  const Dependences& lasting() const { return lasting_; }
  const std::vector<Joint>& joints() const { return joints_; }
  bool empty() const { return frames_.empty() && ties_.empty() && lasting_.empty(); }  // joints are between frames

  // Which ties act at time t [s].
  std::vector<char> active(double t) const;
  // With those ties, where the vertices with free[v] == 0 are held. Where vertices of an affine body are held or tied, as
  // many of its frame follow them as they are independent places: one leaves it three, on a line two, in a plane one.
  // free may be empty where there are no joints: nothing is held.
  Dependences at(const std::vector<char>& free, const std::vector<char>& active_ties) const;
  // The same without joints.
  Dependences unjoined_at(const std::vector<char>& free, const std::vector<char>& active_ties) const;

 private:
  std::vector<AffineFrame> frames_;
  std::vector<Tie> ties_;
  Dependences lasting_;
  std::vector<Joint> joints_;
};

}  // namespace tack
