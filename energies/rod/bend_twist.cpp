#include "energies/rod/bend_twist.hpp"

#include <numbers>

namespace tack {
namespace {

using Vec4 = Eigen::Vector4d;
using Vec6 = Eigen::Matrix<double, 6, 1>;
using Mat6 = Eigen::Matrix<double, 6, 6>;

// Rotation of a transported frame as a function of its edge l.
struct Carried {
  explicit Carried(const Vec3& l) : length(l.norm()), direction(l / length), s(length + l.x(), -l.z(), l.y()) {
    slope << direction.x() + 1, direction.y(), direction.z(), 0, 0, -1, 0, 1, 0;
  }
  Mat3 curvature() const { return (Mat3::Identity() - direction * direction.transpose()) / length; }  // of |l|
  double length;
  Vec3 direction, s;
  Mat3 slope;  // dS/dl
};

double next_to(double angle, double near) {
  constexpr double turn = 2 * std::numbers::pi;
  return angle + turn * std::round((near - angle) / turn);
}

// One strain by (w, x, y, z, theta_1, theta_2).
struct Strain {
  double value;
  Vec6 gradient;
  Mat6 hessian;
};

// u, v and the quantities that depend on them.
struct Rotation {
  Rotation(const Vec4& a, double theta_1, double theta_2)
      : u(a.head<2>()), square(u.squaredNorm()), size(std::sqrt(square)), cosine(std::cos((theta_1 + theta_2) / 2)),
        sine(std::sin((theta_1 + theta_2) / 2)), y((a(2) * cosine + a(3) * sine) * 2 / size),
        z((a(3) * cosine - a(2) * sine) * 2 / size) {}

  // kappa = v' . along / |u| with dv'/dtheta etc.: value, its slope by the mean angle psi, and the direction in (y, z).
  Strain curvature(double value, double slope, const Vec2& along, const Vec2& along_slope) const {
    Strain s{value, Vec6::Zero(), Mat6::Zero()};
    const Vec2 towards = u / square;
    s.gradient << -value * towards, along, slope / 2, slope / 2;
    s.hessian.topLeftCorner<2, 2>() = value * (3 * towards * towards.transpose() - Eigen::Matrix2d::Identity() / square);
    s.hessian.block<2, 2>(0, 2) = -towards * along.transpose();
    s.hessian.block<2, 2>(0, 4).colwise() = -slope / 2 * towards;
    s.hessian.block<2, 2>(2, 4).colwise() = along_slope / 2;
    s.hessian.bottomRightCorner<2, 2>().setConstant(-value / 4);
    s.hessian.triangularView<Eigen::StrictlyLower>() = s.hessian.transpose();
    return s;
  }
  Strain kappa_1() const { return curvature(z, -y, 2 / size * Vec2(-sine, cosine), 2 / size * Vec2(-cosine, -sine)); }
  Strain kappa_2() const { return curvature(-y, -z, -2 / size * Vec2(cosine, sine), -2 / size * Vec2(-sine, cosine)); }
  Strain tau(double value) const {
    Strain s{value, Vec6::Zero(), Mat6::Zero()};
    s.gradient << -2 * u.y() / square, 2 * u.x() / square, 0, 0, -1, 1;
    const double product = 4 * u.x() * u.y() / (square * square), difference = 2 * (u.y() * u.y() - u.x() * u.x()) / (square * square);
    s.hessian.topLeftCorner<2, 2>() << product, difference, difference, -product;
    return s;
  }

  Vec2 u;
  double square, size, cosine, sine;
  double y, z;  // 2 v e^(-i psi) / |u|
};

// C j and C k, -j C and -k C of a quaternion (w, x, y, z).
Vec4 right_j(const Vec4& c) { return {-c(2), -c(3), c(0), c(1)}; }
Vec4 right_k(const Vec4& c) { return {-c(3), c(2), -c(1), c(0)}; }
Vec4 left_j(const Vec4& c) { return {c(2), -c(3), -c(0), c(1)}; }
Vec4 left_k(const Vec4& c) { return {c(3), c(2), -c(1), -c(0)}; }

}  // namespace

BendTwist::BendTwist(const Quaternion& first, const Quaternion& second) {
  const Quaternion q = first.conjugate() * second;
  const Vec4 c(q.w(), q.x(), q.y(), q.z());
  const std::array<Vec4, 3> rows = {c, left_j(c), left_k(c)};
  for (int i = 0; i < 3; ++i) {
    const std::array<Vec4, 3> columns = {rows[i], right_j(rows[i]), right_k(rows[i])};
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 4; ++k) forms_[k](i, j) = columns[j](k);
  }
}

bool BendTwist::within_reach(const Vec3& edge) {
  constexpr double least = 0.01;  // 1 + cos of the angle
  const double length = edge.norm();
  return length + edge.x() > least * length;
}

// Both frames of a pair of edges.
struct BendTwist::PairFrames {
  PairFrames(const BendTwist& bend, const EdgePair& p) : a(p.first), b(p.second) {
    for (int k = 0; k < 4; ++k) {
      from_a[k] = bend.forms_[k] * b.s;
      q(k) = a.s.dot(from_a[k]);
    }
    turn = next_to(std::atan2(q(1), q(0)), p.turn);
  }
  // Returns dq / d(first, second).
  Eigen::Matrix<double, 4, 6> jacobian(const BendTwist& bend) const {
    Eigen::Matrix<double, 4, 6> j;
    for (int k = 0; k < 4; ++k) {
      j.block<1, 3>(k, 0) = from_a[k].transpose() * a.slope;
      j.block<1, 3>(k, 3) = (bend.forms_[k].transpose() * a.s).transpose() * b.slope;
    }
    return j;
  }
  std::array<Strain, 3> strains(const EdgePair& p) const {
    const Rotation r(q, p.theta_1, p.theta_2);
    return {r.kappa_1(), r.kappa_2(), r.tau(2 * turn + p.theta_2 - p.theta_1)};
  }

  Carried a, b;
  std::array<Vec3, 4> from_a;
  Vec4 q;       // w, x, y, z
  double turn;  // arg u
};

double BendTwist::turn(const EdgePair& p) const { return PairFrames(*this, p).turn; }

BendTwist::Strains BendTwist::strains(const EdgePair& p, Slopes* slopes) const {
  const PairFrames at(*this, p);
  const Rotation r(at.q, p.theta_1, p.theta_2);
  if (slopes) {
    const std::array<Strain, 3> strains = at.strains(p);
    const auto jacobian = at.jacobian(*this);
    for (int i = 0; i < 3; ++i)
      slopes->row(i) << strains[i].gradient.head<4>().transpose() * jacobian, strains[i].gradient.tail<2>().transpose();
  }
  return {r.z, -r.y, 2 * at.turn + p.theta_2 - p.theta_1};
}

void BendTwist::derivatives(const EdgePair& p, const Mat3& stiffness, const Strains& rest, Vec8& gradient, Mat8* hessian) const {
  const PairFrames at(*this, p);
  const auto jacobian = at.jacobian(*this);
  const std::array<Strain, 3> strains = at.strains(p);
  const Vec3 force = stiffness * (Vec3(strains[0].value, strains[1].value, strains[2].value) - rest);
  Eigen::Matrix<double, 6, 3> slopes;
  for (int i = 0; i < 3; ++i) slopes.col(i) = strains[i].gradient;
  const Vec6 slope = slopes * force;
  gradient << jacobian.transpose() * slope.head<4>(), slope.tail<2>();
  if (!hessian) return;
  const Mat6 curvature = slopes * stiffness * slopes.transpose() + force(0) * strains[0].hessian + force(1) * strains[1].hessian +
                         force(2) * strains[2].hessian;
  hessian->topLeftCorner<6, 6>().noalias() = jacobian.transpose() * (curvature.topLeftCorner<4, 4>() * jacobian);
  hessian->bottomLeftCorner<2, 6>().noalias() = curvature.bottomLeftCorner<2, 4>() * jacobian;
  hessian->topRightCorner<6, 2>() = hessian->bottomLeftCorner<2, 6>().transpose();
  hessian->bottomRightCorner<2, 2>() = curvature.bottomRightCorner<2, 2>();
  Mat3 form = Mat3::Zero();
  for (int k = 0; k < 4; ++k) form += slope(k) * forms_[k];
  const Mat3 mixed = at.a.slope.transpose() * form * at.b.slope;
  hessian->block<3, 3>(0, 0) += (form * at.b.s).x() * at.a.curvature();
  hessian->block<3, 3>(3, 3) += (form.transpose() * at.a.s).x() * at.b.curvature();
  hessian->block<3, 3>(0, 3) += mixed;
  hessian->block<3, 3>(3, 0) += mixed.transpose();
}

}  // namespace tack
