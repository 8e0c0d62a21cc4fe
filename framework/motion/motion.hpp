// What an object's vertices are made to do: they are held, still or moving, during a time span, and
// free before and after it. Held vertices own no unknowns; released ones keep their velocity.
// Motions are counted from the anchor: where a vertex is when it is seized, its rest position if it
// is held from the start. A step that begins or ends a span in its middle belongs to the side on
// which more of it lies.
// One with a carrier, another object, is told in the frame of that: what it does, then what the motion of that object does to
// space (carried_motion.hpp).
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "framework/body/rigid_map.hpp"
#include "framework/body/selection.hpp"
#include "framework/config/field.hpp"

namespace tack {

class Motion : public Component {
 public:
  static constexpr const char* kind_name = "motion";
  static constexpr const char* kind_doc = "Prescribes the motion of some vertices of an object.";

  Motion() = default;
  Motion(double from, double until) : from_(from), until_(until) {}
  void fields(Fields& f) override;
  const Selection& selection() const { return *select_; }
  const std::string& carrier() const { return carrier_; }  // the object that it goes along with; empty: none
  double from() const { return from_; }                                                     // s
  double until() const { return until_.value_or(std::numeric_limits<double>::infinity()); }  // s

  // Whether it holds its vertices in some directions only, and what projects onto those that it does.
  bool partial() const { return along_ || across_; }
  Mat3 held_directions() const;

  // Writes where the vertices are at time t [s] into their rows of x; rest, anchor: 3n [m].
  virtual void place(std::span<const int> vertices, const VecX& rest, const VecX& anchor, double t,
                     VecX& x) const = 0;
  // Beside from and until, the times at which it changes abruptly [s]: steps that adapt end there.
  virtual std::vector<double> corners() const { return {}; }
  virtual bool moves() const { return true; }  // false: they stay at their anchor
  virtual bool rigid() const { return true; }  // distances between them do not change
  // What it makes of space until time t [s], where it moves rigidly; else none, and it carries nothing.
  virtual std::optional<RigidMap> pose(double) const { return {}; }

 private:
  std::unique_ptr<Selection> select_ = Registry<Selection>::make("all");
  std::string carrier_;
  double from_ = 0;
  std::optional<double> until_;
  std::optional<Vec3> along_, across_;
};

}  // namespace tack
