// Forces along the coordinate q of a joint, with v the rate of q at the end of a step:
//     friction         T f(|v| / e) against v, and c v
//     velocity motor   T f(|w - v| / e) towards a rate w
//     position motor   T f(|p - q| / e) towards a value p
// f(y) = 2 y - y^2 for y < 1, else 1. T: largest force; e: width below which the force is smaller,
// as in friction of contact. Each step has the potential e T / (dv/dq) F, F' = f.
#pragma once

#include <cmath>
#include <memory>

#include "energies/interactions/joint_limits.hpp"
#include "framework/config/schedule.hpp"
#include "framework/core/records.hpp"

namespace tack {

enum class DriveKind { friction, motor, position_motor };

template <class Coordinate>
struct JointDrive : FormulaOf<Coordinate::arity> {
  static constexpr bool stored = false;
  struct Data {
    DriveKind kind;
    double most, soft, damping, offset;  // T, e, c
    double near = 0;                     // the coordinate before the step
    double still = 0, rate = 1;          // v = rate (q - still); position motor: 0 and 1
    double target = 0;                   // w, p
  };
  static double saturation(double y) { return y < 1 ? 2 * y - y * y : 1; }
  template <class T>
  T energy(const std::array<Eigen::Matrix<T, 3, 1>, Coordinate::arity>& x, const Data& d) const {
    using std::abs;
    const T v = d.rate * (joint_coordinate<Coordinate, T>(x, d.offset, d.near) - d.still);
    const T off = v - d.target, y = abs(off) / d.soft;
    const T integral = y < T(1) ? T(y * y - y * y * y / 3.0) : T(y - 1.0 / 3);
    return (d.most * d.soft * integral + 0.5 * d.damping * off * off) / d.rate;
  }
  // Returns the force along the coordinate.
  static double drive(const Data& d, double q) {
    const double off = d.rate * (q - d.still) - d.target;
    return -(d.most * std::copysign(saturation(std::abs(off) / d.soft), off) + d.damping * off);
  }
};

template <class Coordinate>
class JointDriveTerm : public FormulaTerm<JointDrive<Coordinate>> {
 public:
  using Data = typename JointDrive<Coordinate>::Data;

  explicit JointDriveTerm(std::shared_ptr<JointCoordinate<Coordinate>> coordinate)
      : FormulaTerm<JointDrive<Coordinate>>("joint_drives"), coordinate_(std::move(coordinate)) {}
  void drive(DriveKind kind, double most, double soft, double damping, Schedule target) {
    this->add(coordinate_->vertices(),
              {kind, most, soft, damping, coordinate_->offset(), coordinate_->offset(),
               kind == DriveKind::position_motor ? 0 : coordinate_->offset(), 1, target.at(0)});
    targets_.push_back(std::move(target));
  }
  // Returns the force of all drives of a kind, for the step that ends at x.
  double exerted(DriveKind kind, const VecX& x) const {
    double sum = 0;
    for (const Data& d : this->data())
      if (d.kind == kind) sum += JointDrive<Coordinate>::drive(d, coordinate_->at(x));
    return sum;
  }

  void begin_step(const StepStart& start) override {
    const double now = coordinate_->at(start.x);
    const double still = start.velocity ? near(start.velocity->still, now) : now,
                 rate = start.velocity ? start.velocity->rate : 1 / start.h;
    for (int s = 0; s < this->count(); ++s) {
      Data& d = this->data()[s];
      d.near = now;
      if (d.kind != DriveKind::position_motor) d.still = still, d.rate = rate;
      d.target = targets_[s].at(start.time + start.h);
    }
  }
  std::vector<double> abrupt_times() const override {
    std::vector<double> times;
    for (const Schedule& target : targets_)
      for (const double t : target.corners()) times.push_back(t);
    return times;
  }
  void load_history(const History& history) override { coordinate_->load_history(history); }
  void commit(const VecX& x, History& history) const override { coordinate_->commit(x, history); }

  void publish(Records& records) const override {
    Term::publish(records);
    records.add(
        FlowRecord{this->name(),
                   {{"dissipated_joints", FlowKind::dissipated}, {"work_motors", FlowKind::fed}},
                   [this](const VecX& x, double* amounts) {
                     amounts[0] = amounts[1] = 0;
                     const double q = coordinate_->at(x);
                     for (const Data& d : this->data()) {
                       const double work = JointDrive<Coordinate>::drive(d, q) * (q - d.near);
                       if (d.kind == DriveKind::friction) amounts[0] -= work;
                       else amounts[1] += work;
                     }
                   }});
  }

 private:
  double near(const VecX& x, double value) const {
    const double q = coordinate_->at(x);
    return q + Coordinate::turns(q, value);
  }

  std::shared_ptr<JointCoordinate<Coordinate>> coordinate_;
  std::vector<Schedule> targets_;
};

}  // namespace tack
