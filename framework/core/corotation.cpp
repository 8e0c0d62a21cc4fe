#include "framework/core/corotation.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cmath>

namespace tack {
namespace {

constexpr double undetermined = 1e-10;  // eigenvalues of A below this fraction of the largest one: no rotation

// Returns the inverse of a symmetric matrix by absolute eigenvalues, 0 along eigenvectors of small ones.
Mat3 inverse_of(const Mat3& a) {
  const double size = a.cwiseAbs().maxCoeff();
  if (size == 0) return Mat3::Zero();
  constexpr double safe = 1e-4;
  const double minor = a(0, 0) * a(1, 1) - a(0, 1) * a(1, 0), determinant = a.determinant();
  if (a(0, 0) > safe * size && minor > safe * size * size && determinant > safe * size * size * size) return a.inverse();
  const Eigen::SelfAdjointEigenSolver<Mat3> eigen(a);
  const double largest = eigen.eigenvalues().cwiseAbs().maxCoeff();
  Mat3 inverse = Mat3::Zero();
  for (int k = 0; k < 3; ++k)
    if (const double e = std::abs(eigen.eigenvalues()(k)); e > undetermined * largest) inverse += eigen.eigenvectors().col(k) * eigen.eigenvectors().col(k).transpose() / e;
  return inverse;
}

// Returns sum s_i x y_i, given S = sum y_i s_i^T.
Vec3 moment_of(const Mat3& s) { return {s(2, 1) - s(1, 2), s(0, 2) - s(2, 0), s(1, 0) - s(0, 1)}; }

// tr(S) I - S, symmetric.
Mat3 resistance_of(const Mat3& s) { return s.trace() * Mat3::Identity() - (s + s.transpose()) / 2; }

// Returns the rotation R for which S = R^T S_0 is symmetric with the largest trace. Newton's method
// from the identity; an isotropic stencil takes one step.
Mat3 rotation_of(const Mat3& s_0) {
  constexpr int most_steps = 30;
  constexpr double exact = 1e-15;
  Mat3 r = Mat3::Identity();
  for (int i = 0; i < most_steps; ++i) {
    const Mat3 s = r.transpose() * s_0;
    const Vec3 turn = inverse_of(resistance_of(s)) * moment_of(s);
    const double tangent = turn.norm();
    if (!(tangent > exact)) break;
    r = r * Eigen::AngleAxisd(std::atan(tangent), turn / tangent).toRotationMatrix();
  }
  return r;
}

// Subtracts the mean of the count and returns it.
Vec3 centre(int count, Corotation::Column& x) {
  Vec3 mean = Vec3::Zero();
  for (int i = 0; i < count; ++i) mean += x.segment<3>(3 * i);
  mean /= count;
  for (int i = 0; i < count; ++i) x.segment<3>(3 * i) -= mean;
  return mean;
}

}  // namespace

Corotation::Corotation(int count, const Column& s, const Column& x, bool translates)
    : position_count_(count), translation_(translates), s_(s), y_(x), u_(x - s) {
  const Vec3 moved = translation_ * (centre(count, y_) - centre(count, s_));
  Mat3 sum = Mat3::Zero();
  for (int i = 0; i < count; ++i) sum += y(i) * this->s(i).transpose();
  r_ = rotation_of(sum);
  inverse_ = inverse_of(resistance_of(r_.transpose() * sum));
  for (int i = 0; i < count; ++i) {
    y_.segment<3>(3 * i) = r_.transpose() * y(i);
    u_.segment<3>(3 * i) = y(i) - this->s(i) + moved;
  }
}

Corotation::Column Corotation::gradient(const Column& f) const {
  Vec3 moment = Vec3::Zero(), sum = Vec3::Zero(), mean = Vec3::Zero();
  for (int i = 0; i < position_count_; ++i) {
    moment += y(i).cross(Vec3(f.segment<3>(3 * i)));
    sum += f.segment<3>(3 * i);
  }
  const Vec3 a = inverse_ * moment;
  Column g = f;
  for (int i = 0; i < position_count_; ++i) {
    g.segment<3>(3 * i) = r_ * (f.segment<3>(3 * i) - a.cross(s(i)));
    mean += g.segment<3>(3 * i);
  }
  for (int i = 0; i < position_count_; ++i) g.segment<3>(3 * i) += (translation_ * sum - mean) / position_count_;
  return g;
}

Corotation::Square Corotation::slopes() const {
  Square b = Square::Identity(u_.size(), u_.size());
  const double weight = 1.0 / position_count_;
  for (int j = 0; j < position_count_; ++j)
    for (int k = 0; k < 3; ++k) {
      const Vec3 back = r_.row(k).transpose();  // R^T e_k
      const Vec3 turn = inverse_ * s(j).cross(back);
      for (int i = 0; i < position_count_; ++i) {
        Vec3 column = ((i == j ? 1 : 0) - weight) * back - turn.cross(y(i));
        column(k) += translation_ * weight;
        b.block<3, 1>(3 * i, 3 * j + k) = column;
      }
    }
  return b;
}

Corotation::Square Corotation::hessian(const Square& k, const Column& f) const {
  const Square b = slopes(), kb = k * b;
  Vec3 moment = Vec3::Zero();
  for (int i = 0; i < position_count_; ++i) moment += y(i).cross(Vec3(f.segment<3>(3 * i)));
  const Vec3 a = inverse_ * moment;
  Square h = kb;
  const double weight = 1.0 / position_count_;
  for (int j = 0; j < position_count_; ++j)
    for (int axis = 0; axis < 3; ++axis) {
      const int column = 3 * j + axis;
      const Vec3 turn = inverse_ * s(j).cross(Vec3(r_.row(axis).transpose()));
      Vec3 d_moment = Vec3::Zero(), d_a = Vec3::Zero();  // the latter: (dA)^T a
      const auto d_y = [&](int i) {
        Vec3 d = b.block<3, 1>(3 * i, column);
        d(axis) -= translation_ * weight;
        return d;
      };
      for (int i = 0; i < position_count_; ++i) {
        const Vec3 d = d_y(i), d_f = kb.block<3, 1>(3 * i, column);
        d_moment += d.cross(Vec3(f.segment<3>(3 * i))) + y(i).cross(d_f);
        d_a += s(i).dot(d) * a - s(i) * d.dot(a);
      }
      const Vec3 change = inverse_ * (d_moment - d_a);
      Vec3 sum = Vec3::Zero(), mean = Vec3::Zero();
      for (int i = 0; i < position_count_; ++i) {
        const Vec3 d_f = kb.block<3, 1>(3 * i, column), g = Vec3(f.segment<3>(3 * i)) - a.cross(s(i));
        h.block<3, 1>(3 * i, column) = r_ * (d_f - change.cross(s(i)) + turn.cross(g));
        sum += d_f;
        mean += h.block<3, 1>(3 * i, column);
      }
      for (int i = 0; i < position_count_; ++i) h.block<3, 1>(3 * i, column) += (translation_ * sum - mean) * weight;
    }
  // Scalar dofs are not rotated: their columns are those of K; forces on positions are rotated as usual.
  for (Eigen::Index column = 3 * position_count_; column < h.cols(); ++column) h.col(column) = gradient(Column(k.col(column)));
  return (h + h.transpose()) / 2;
}

Corotation::Column Corotation::without_rotation(int count, const Column& s, const Column& d) {
  Column from = s, rest = d;
  centre(count, from);
  Mat3 sum = Mat3::Zero();
  Vec3 moment = Vec3::Zero();
  for (int i = 0; i < count; ++i) {
    const Vec3 at = from.segment<3>(3 * i);
    sum += at * at.transpose();
    moment += at.cross(Vec3(d.segment<3>(3 * i)));
  }
  const Vec3 turn = inverse_of(resistance_of(sum)) * moment;
  for (int i = 0; i < count; ++i) rest.segment<3>(3 * i) -= turn.cross(Vec3(from.segment<3>(3 * i)));
  return rest;
}

}  // namespace tack
