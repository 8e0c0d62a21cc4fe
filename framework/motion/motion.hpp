// Prescribed motion (Dirichlet condition) of vertices of an object, at rest or moving, during a
// time span. Before and after the span the vertices are free. Fixed vertices own no unknowns;
// released vertices keep their velocity.
//   reference      reference position of the motion: the position at the start of the span, or at
//                  rest if the span begins with the run
//   partial steps  a step that contains the start or the end of a span belongs to the side that
//                  has the larger fraction of it
//   carrier        another object: the motion is given in its frame and followed by its rigid
//                  motion (relative_motion.hpp)
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
#include "framework/protocol/drives.hpp"

namespace tack {

class Motion : public Component {
 public:
  static constexpr const char* kind_name = "motion";
  static constexpr const char* kind_doc = "Prescribes the motion of some vertices of an object.";

  Motion() = default;
  Motion(double from, double until) : from_(from), until_(until) {}
  void fields(Fields& f) override;
  const Selection& selection() const { return *select_; }
  // Returns the name of the carrier; empty: none.
  const std::string& carrier() const { return carrier_; }
  // Return the start and the end of the time span [s].
  double from() const { return from_; }
  double until() const { return until_.value_or(std::numeric_limits<double>::infinity()); }

  // Returns whether the motion fixes only some directions.
  bool partial() const { return along_ || across_; }
  // Returns the projection onto the fixed directions.
  Mat3 fixed_directions() const;

  // Writes the prescribed positions at time t [s] into the rows of x; rest, reference: 3n [m].
  virtual void set_positions(std::span<const int> vertices, const VecX& rest, const VecX& reference,
                             double t, VecX& x) const = 0;
  // Returns the times of discontinuities [s] other than `from` and `until`. Adaptive steps end
  // there.
  virtual std::vector<double> corners() const { return {}; }
  // Returns false if the vertices stay at their reference positions.
  virtual bool moves() const { return true; }
  // Returns whether the vertices keep their distances.
  virtual bool rigid() const { return true; }
  // Returns the rigid map from the start of the motion to time t [s]. Returns nothing if the motion
  // is not rigid; then it cannot be the carrier of another motion.
  virtual std::optional<RigidMap> pose(double) const { return {}; }
  // Returns the drive of a protocol that moves the vertices; empty: none. Worlds have instances of
  // their own of such a motion, which follow the drives of the world.
  virtual std::string drive() const { return {}; }
  virtual FollowerKind drive_kind() const { return FollowerKind::unused; }
  virtual void follow(const Drive& /*drive*/) {}
  // Returns whether its positions are unknown before the run.
  virtual bool unbounded() const { return false; }

 private:
  std::unique_ptr<Selection> select_ = Registry<Selection>::make("all");
  std::string carrier_;
  double from_ = 0;
  std::optional<double> until_;
  std::optional<Vec3> along_, across_;
};

}  // namespace tack
