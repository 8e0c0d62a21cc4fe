// Sliders: an affine body moves along a line and does not rotate. A line in space is a fixed direction. A line on another object rotates with that
// object, which is not linear in the unknowns: a stiff potential keeps the point on such a line.
#include <fmt/format.h>

#include <cmath>

#include "energies/interactions/joint_mechanics.hpp"
#include "energies/interactions/joint_points.hpp"
#include "energies/interactions/joint_strength.hpp"

namespace tack {
namespace {

inline constexpr Unit damping{"N s/m", "damping"};
inline constexpr JointUnits of_sliders{units::length, units::velocity, units::force, damping, "way", "force", 1e-4, 1e-3, 1e-3};  // m, m/s, m

// k/2 of the square of the distance of a point from a line.
struct OnLine : FormulaOf<3> {
  struct Data {
    double stiffness;  // N/m
  };
  template <class T>
  T energy(const Positions<T>& x, const Data& d) const {
    const Eigen::Matrix<T, 3, 1> line = x[2] - x[1], from = x[0] - x[1];
    const T along = from.dot(line) / line.squaredNorm();
    const Eigen::Matrix<T, 3, 1> off = from - line * along;  // not by a difference of squares, which has no digits left
    return 0.5 * d.stiffness * off.squaredNorm();
  }
};

class OnLineTerm : public FormulaTerm<OnLine> {
 public:
  OnLineTerm() : FormulaTerm("joint_lines") {}
  double off(const VecX& x) const { return std::sqrt(std::max(0.0, 2 * energy(0, x) / data()[0].stiffness)); }
};

class Slider : public Interaction {
 public:
  void fields(Fields& f) override {
    Interaction::fields(f);
    ends_.fields(f);
    f.vector("axis", axis_, units::none, "direction of the displacement").required();
    mechanics_.fields(f);
    f.optional_number("stiffness", stiffness_, units::stiffness, "stiffness of the line on another object; that of the bodies unless given").positive();
  }
  std::vector<std::string> objects() const override { return ends_.objects(); }

  void build(InteractionBuilder& builder) const override {
    if (axis_.norm() == 0) throw InputError(fmt::format("slider '{}' has an axis without a direction; give it one", builder.name()));
    const Vec3 axis = axis_.normalized();
    JointPoints points(builder, ends_);
    const double spacing = points.spacing();
    const std::array<Vec3, 2> sides = across(axis);
    const std::array<Vec3, 4> at = {ends_.at, ends_.at + spacing * axis, ends_.at + spacing * sides[0], ends_.at + spacing * sides[1]};
    std::array<int, 4> own, others;
    for (int i = 0; i < 4; ++i) own[i] = points.of_object(at[i]), others[i] = points.of_other(at[i]);
    for (int i = 1; i < 4; ++i) points.joint().relations.push_back({{own[i], 1.0}, {own[0], -1.0}, {others[i], -1.0}, {others[0], 1.0}});
    int moved = own[0];
    if (points.other() < 0) {
      moved = builder.unknowns().add_vector_dofs("place", std::vector{ends_.at})[0];
      builder.unknowns().fix_directions(moved, Mat3::Identity() - axis * axis.transpose());
      points.joint().relations.push_back({{own[0], 1.0}, {moved, -1.0}});
    } else {
      auto line = std::make_unique<OnLineTerm>();
      const double strength = joint_strength(builder.world(), points.object(), points.other());  // N m, at a strain of 1e-4
      line->add({own[0], others[0], others[1]}, {stiffness_.value_or(strength / (tolerated_affine_strain * spacing * spacing))});
      points.joint().play = [term = line.get()](const VecX& x) { return term->off(x); };
      builder.add(std::move(line));
    }
    const double effort = joint_strength(builder.world(), points.object(), points.other()) / spacing;
    points.finish();
    mechanics_.build(builder, {moved, others[0], others[1]}, effort);
  }

 private:
  JointEnds ends_;
  Vec3 axis_ = Vec3::Zero();
  MechanicsKeys<SliderDisplacement, of_sliders> mechanics_;
  std::optional<double> stiffness_;  // N/m
};

using SliderDisplacementProbe = CoordinateProbe<SliderDisplacement, of_sliders>;
using MotorForce = DriveProbe<SliderDisplacement, of_sliders>;

TACK_REGISTER(Interaction, Slider, "slider", "Slider joint: an affine body translates along a line of another object or of space without rotating "
                                             "relative to it; optional limits, friction and motors.", "");
TACK_REGISTER(Probe, SliderDisplacementProbe, "joint_way", "Displacement of a slider along its line [m].", "");
TACK_REGISTER(Probe, MotorForce, "motor_force", "Force of the velocity motor and the position motor of a slider along its line [N].", "");

}  // namespace
}  // namespace tack
