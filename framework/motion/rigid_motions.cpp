// Rigid prescribed motions: translate, rotate, hinge, keyframes.
#include <Eigen/Geometry>
#include <algorithm>

#include "framework/motion/motion.hpp"

namespace tack {
namespace {

Mat3 rotation(double angle, const Vec3& axis) { return Eigen::AngleAxisd(angle, axis).toRotationMatrix(); }

// Interpolation between two frames: constant speed, or rest at both ends.
enum class Easing { linear, smooth };

void easing_field(Fields& f, Easing& easing) {
  f.choice("easing", easing, {{"linear", Easing::linear, "at constant speed"},
                              {"smooth", Easing::smooth, "from rest to rest, by 3 u^2 - 2 u^3"}},
           "interpolation from one frame to the next");
}

double eased(Easing easing, double u) { return easing == Easing::smooth ? u * u * (3 - 2 * u) : u; }

// Motion at constant speed for a limited duration.
class SteadyMotion : public Motion {
 public:
  std::vector<double> corners() const override { return duration_ ? std::vector{from() + *duration_} : std::vector<double>(); }

 protected:
  void duration_field(Fields& f, const char* doc) {
    f.optional_number("duration", duration_, units::time, doc).positive();
  }
  bool ends() const { return duration_ || until() < std::numeric_limits<double>::infinity(); }
  // Returns the displacement at time t, from a speed or a total displacement. Without a duration the
  // motion continues to the end of the last step, which may lie a little after `until`. Released
  // vertices thus keep their speed.
  template <class T>
  T displacement(const std::optional<T>& speed, const std::optional<T>& total, double t) const {
    double s = std::max(t - from(), 0.0);
    if (duration_) s = std::min(s, *duration_);
    return speed ? T(*speed * s) : T(*total * (s / duration_.value_or(until() - from())));
  }

 private:
  std::optional<double> duration_;  // s
};

// x = reference + v s or reference + d s / duration, s the time since `from`, at most the duration.
class Translate : public SteadyMotion {
 public:
  void fields(Fields& f) override {
    f.optional_vector("velocity", velocity_, units::velocity, "constant velocity; or give displacement");
    f.optional_vector("displacement", displacement_, units::length,
                      "displacement within the duration, at constant velocity; or give velocity");
    duration_field(f, "duration of the displacement, after which the vertices are fixed; until the end of the motion unless given");
    f.check("velocity", [this]() -> std::string {
      return velocity_.has_value() != displacement_.has_value() ? "" : "give either velocity or displacement";
    });
    f.check("displacement", [this]() -> std::string {
      return !displacement_ || ends() ? "" : "needs the duration that it takes";
    });
    Motion::fields(f);
  }
  void set_positions(std::span<const int> vertices, const VecX&, const VecX& reference, double t,
             VecX& x) const override {
    const Vec3 d = displacement(velocity_, displacement_, t);
    for (const int v : vertices) vertex(x, v) = vertex(reference, v) + d;
  }
  std::optional<RigidMap> pose(double t) const override { return RigidMap{Mat3::Identity(), displacement(velocity_, displacement_, t)}; }

 private:
  std::optional<Vec3> velocity_, displacement_;  // m/s, m
};

// x = c + R(axis, angle) (reference - c).
class Rotate : public SteadyMotion {
 public:
  void fields(Fields& f) override {
    f.vector("axis", axis_, units::none, "direction of the axis; rotations about it are right-handed").required();
    f.vector("centre", centre_, units::length, "a point of the axis");
    f.optional_number("angular_velocity", speed_, units::angular_velocity,
                      "constant angular velocity; or give angle");
    f.optional_number("angle", angle_, units::angle,
                      "angle of rotation within the duration, at constant speed; or give angular_velocity");
    duration_field(f, "duration of the rotation, after which the vertices are fixed; until the end of the motion unless given");
    f.check("axis", [this]() -> std::string { return axis_.norm() > 0 ? "" : "must not be zero"; });
    f.check("angular_velocity", [this]() -> std::string {
      return speed_.has_value() != angle_.has_value() ? "" : "give either angular_velocity or angle";
    });
    f.check("angle", [this]() -> std::string {
      return !angle_ || ends() ? "" : "needs the duration that it takes";
    });
    Motion::fields(f);
  }
  void set_positions(std::span<const int> vertices, const VecX&, const VecX& reference, double t,
             VecX& x) const override {
    const Mat3 r = rotation(displacement(speed_, angle_, t), axis_.normalized());
    for (const int v : vertices) vertex(x, v) = centre_ + r * (vertex(reference, v) - centre_);
  }
  std::optional<RigidMap> pose(double t) const override {
    return RigidMap::about(centre_, rotation(displacement(speed_, angle_, t), axis_.normalized()));
  }

 private:
  Vec3 axis_ = Vec3::UnitY(), centre_ = Vec3::Zero();  // -, m
  std::optional<double> speed_, angle_;                // rad/s, rad
};

// x = c + R(axis, angle(t)) (reference - c).
class HingeMotion : public Motion {
 public:
  void fields(Fields& f) override {
    f.vector("axis", axis_, units::none, "direction of the axis; rotations about it are right-handed").required();
    f.vector("centre", centre_, units::length, "a point of the axis");
    f.schedule("angle", angle_, units::angle, "angle of rotation: [[time, angle], ...], constant before and after").required();
    easing_field(f, easing_);
    f.check("axis", [this]() -> std::string { return axis_.norm() > 0 ? "" : "must not be zero"; });
    Motion::fields(f);
  }
  void set_positions(std::span<const int> vertices, const VecX&, const VecX& reference, double t, VecX& x) const override {
    const RigidMap map = *pose(t);
    for (const int v : vertices) vertex(x, v) = map(vertex(reference, v));
  }
  std::vector<double> corners() const override { return angle_.corners(); }
  bool moves() const override { return !angle_.constant(); }
  std::optional<RigidMap> pose(double t) const override { return RigidMap::about(centre_, rotation(angle(t), axis_.normalized())); }

 private:
  double angle(double t) const {
    const auto& points = angle_.points();
    const auto later = std::find_if(points.begin(), points.end(), [t](const Schedule::Point& p) { return p.time > t; });
    if (later == points.begin() || later == points.end()) return angle_.at(t);
    const Schedule::Point &a = *(later - 1), &b = *later;
    return a.value + eased(easing_, (t - a.time) / (b.time - a.time)) * (b.value - a.value);
  }

  Vec3 axis_ = Vec3::UnitZ(), centre_ = Vec3::Zero();  // -, m
  Schedule angle_;                                     // rad
  Easing easing_ = Easing::linear;
};

struct Keyframe {
  double time = 0;                  // s
  Vec3 translation = Vec3::Zero();  // m
  Vec3 rotation = Vec3::Zero();     // rad, axis times angle
  void fields(Fields& f) {
    f.number("time", time, units::time, "time of the frame").required();
    f.vector("translation", translation, units::length, "displacement from the position at `from`, applied after the rotation");
    f.vector("rotation", rotation, units::angle, "axis times angle, about the centre");
  }
};

// x = c + R(w) (reference - c) + d. The displacement d and the rotation vector w are interpolated
// between the frames and constant outside them.
class Keyframes : public Motion {
 public:
  void fields(Fields& f) override {
    f.vector("centre", centre_, units::length, "fixed point of the rotations");
    f.list("frames", frames_, "keyframes; straight paths in between, constant before and after")
        .required().nonempty();
    easing_field(f, easing_);
    f.check("frames", [this]() -> std::string {
      const auto not_later = [](const Keyframe& a, const Keyframe& b) { return b.time <= a.time; };
      return std::adjacent_find(frames_.begin(), frames_.end(), not_later) == frames_.end()
                 ? "" : "times must increase from frame to frame";
    });
    Motion::fields(f);
  }
  void set_positions(std::span<const int> vertices, const VecX&, const VecX& reference, double t,
             VecX& x) const override {
    const Keyframe k = at(t);
    const Mat3 r = rotation_of(k);
    for (const int v : vertices)
      vertex(x, v) = centre_ + r * (vertex(reference, v) - centre_) + k.translation;
  }
  std::optional<RigidMap> pose(double t) const override {
    const Keyframe k = at(t);
    return RigidMap::about(centre_, rotation_of(k), k.translation);
  }

  std::vector<double> corners() const override {
    std::vector<double> times;
    for (const Keyframe& k : frames_) times.push_back(k.time);
    return times;
  }

 private:
  static Mat3 rotation_of(const Keyframe& k) {
    const double angle = k.rotation.norm();
    return rotation(angle, angle > 0 ? Vec3(k.rotation / angle) : Vec3::UnitX());
  }
  Keyframe at(double t) const {
    const auto later =
        std::find_if(frames_.begin(), frames_.end(), [t](const Keyframe& k) { return k.time > t; });
    if (later == frames_.begin()) return frames_.front();
    if (later == frames_.end()) return frames_.back();
    const Keyframe &a = *(later - 1), &b = *later;
    const double u = eased(easing_, (t - a.time) / (b.time - a.time));
    return {t, a.translation + u * (b.translation - a.translation),
            a.rotation + u * (b.rotation - a.rotation)};
  }

  Vec3 centre_ = Vec3::Zero();  // m
  std::vector<Keyframe> frames_ = {Keyframe{}};
  Easing easing_ = Easing::linear;
};

TACK_REGISTER(Motion, Translate, "translate", "Moves vertices along a line at constant velocity.", "");
TACK_REGISTER(Motion, Rotate, "rotate", "Rotates vertices about an axis at constant angular velocity.", "");
TACK_REGISTER(Motion, HingeMotion, "hinge", "Rotates vertices about an axis by prescribed angles: the lid of a box, an arm of a chain.", "");
TACK_REGISTER(Motion, Keyframes, "keyframes",
              "Moves vertices rigidly through keyframes, along straight paths.", "");

}  // namespace
}  // namespace tack
