// Scene keys of the forces along the coordinate of a joint, and their terms.
#pragma once

#include <fmt/format.h>

#include <limits>
#include <memory>
#include <optional>

#include "energies/interactions/joint_drive.hpp"
#include "framework/config/field.hpp"
#include "framework/probes/interaction_probe.hpp"
#include "framework/setup/interaction_builder.hpp"
#include "geometry/errors.hpp"

namespace tack {

// A hinge has angles and torques, a slider displacements and forces.
struct JointUnits {
  Unit value, rate, effort, damping;
  const char* what;        // "angle"
  const char* effort_key;  // "torque"
  // Default widths of position motors, of friction and rate motors, and of limits.
  double soft, soft_rate, margin;
};

struct JointMotor {
  Schedule target;
  double most = 0, soft = 0;
};

template <const JointUnits& U>
struct MotorKeys : JointMotor {
  MotorKeys() { soft = U.soft_rate; }
  void fields(Fields& f) {
    f.schedule("speed", target, U.rate, "target rate over time").required();
    f.number(U.effort_key, most, U.effort, "largest magnitude").required().positive();
    f.number("within", soft, U.rate, "rate error at which the motor saturates").positive();
  }
};

template <const JointUnits& U>
struct PositionMotorKeys : JointMotor {
  PositionMotorKeys() { soft = U.soft; }
  void fields(Fields& f) {
    f.schedule(U.what, target, U.value, "target over time").required();
    f.number(U.effort_key, most, U.effort, "largest magnitude").required().positive();
    f.number("within", soft, U.value, "error at which the motor saturates").positive();
  }
};

template <const JointUnits& U>
struct FrictionKeys {
  double most = 0, soft = U.soft_rate;
  void fields(Fields& f) {
    f.number(U.effort_key, most, U.effort, "magnitude of the dry friction").required().positive();
    f.number("eps", soft, U.rate,
             "rate below which friction is regularised: a joint at rest creeps")
        .positive();
  }
};

template <const JointUnits& U>
struct LimitKeys {
  std::optional<double> low, high, effort;
  double margin = U.margin;
  void fields(Fields& f) {
    f.optional_number("low", low, U.value, "lower limit");
    f.optional_number("high", high, U.value, "upper limit");
    f.number("margin", margin, U.value, "distance to a limit at which resistance begins")
        .positive();
    f.optional_number(U.effort_key, effort, U.effort,
                      "magnitude at half of the margin; it diverges at the limit; unless given, "
                      "derived from the "
                      "stiffness of the bodies")
        .positive();
    f.check("low", [this] {
      return low && high && *low >= *high ? std::string("is not below `high`; exchange them")
                                          : std::string();
    });
  }
};

template <class Coordinate, const JointUnits& U>
struct MechanicsKeys {
  double start = 0, damping = 0;
  std::optional<LimitKeys<U>> limits;
  std::optional<FrictionKeys<U>> friction;
  std::optional<MotorKeys<U>> motor;
  std::optional<PositionMotorKeys<U>> position_motor;

  void fields(Fields& f) {
    f.number("start", start, U.value, "initial coordinate along or about the axis");
    f.optional_object("limits", limits, "unilateral limits, never exceeded");
    f.optional_object("friction", friction, "dry friction of prescribed magnitude");
    f.number("damping", damping, U.damping, "viscous damping").nonnegative();
    f.optional_object("motor", motor, "velocity motor");
    f.optional_object("position_motor", position_motor, "position motor");
  }

  // effort: default of the force or moment of limits at half of their margin.
  void build(InteractionBuilder& builder, const std::array<int, Coordinate::arity>& vertices,
             double effort) const {
    const auto coordinate = std::make_shared<JointCoordinate<Coordinate>>(
        vertices, start, builder.add_history(U.what, 1, 1));
    auto limit = std::make_unique<JointLimitTerm<Coordinate>>(coordinate, builder.name(), U.what,
                                                              std::string(U.value.si));
    if (limits) {
      // 1/2 + ln 2.
      constexpr double infinite = std::numeric_limits<double>::infinity(),
                       at_half = 1.1931471805599453;
      const double low = limits->low.value_or(-infinite), high = limits->high.value_or(infinite);
      if (!(low < start && start < high))
        throw InputError(
            fmt::format("joint '{}' starts at {:.6g} {}, not between its limits, {:.6g} and "
                        "{:.6g}; change these, or `start`",
                        builder.name(), start, U.value.si, low, high));
      limit->limit(low, high, limits->margin,
                   limits->effort.value_or(effort) / (limits->margin * at_half));
    }
    builder.add(std::move(limit));
    if (!friction && damping == 0 && !motor && !position_motor) return;
    auto drive = std::make_unique<JointDriveTerm<Coordinate>>(coordinate);
    if (friction || damping > 0)
      drive->drive(DriveKind::friction, friction ? friction->most : 0,
                   friction ? friction->soft : 1, damping, 0.0);
    if (motor) drive->drive(DriveKind::motor, motor->most, motor->soft, 0, motor->target);
    if (position_motor)
      drive->drive(DriveKind::position_motor, position_motor->most, position_motor->soft, 0,
                   position_motor->target);
    builder.add(std::move(drive));
  }
};

// Probes of the coordinate, and of the forces of motors along it.
template <class Coordinate, const JointUnits& U>
class CoordinateProbe : public InteractionProbe<JointLimitTerm<Coordinate>, Probe> {
 public:
  Unit unit() const override { return U.value; }
  std::vector<double> sample(const World&, const State& state) override {
    return {this->term().coordinate().at(state.x)};
  }
};

template <class Coordinate, const JointUnits& U>
class DriveProbe : public InteractionProbe<JointDriveTerm<Coordinate>, Probe> {
 public:
  Unit unit() const override { return U.effort; }
  std::vector<double> sample(const World&, const State& state) override {
    return {this->term().exerted(DriveKind::motor, state.x) +
            this->term().exerted(DriveKind::position_motor, state.x)};
  }
};

}  // namespace tack
