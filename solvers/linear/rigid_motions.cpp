#include "solvers/linear/rigid_motions.hpp"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <utility>

#include "framework/core/lanes.hpp"
#include "geometry/parallel.hpp"

namespace tack {
namespace {

// Fraction of an aggregate's largest moment of inertia, below which its rotation about an axis is
// left out.
constexpr double slender = 1e-4;
// Fraction of the diagonal, against breakdown of free motions by rounding.
constexpr double shift = 1e-12;

Mat3 matrix3(const BlockLanes& lanes) {
  Mat3 m;
  lanes.store(m.data());
  return m;
}

}  // namespace

bool RigidMotions::update(const BlockMatrix& matrix) {
  const size_t n = matrix.columns();
  if (matrix.component.size() != n || static_cast<size_t>(matrix.positions.size()) != 3 * n) return false;
  const bool cut = component_ != matrix.component;
  if (cut) {
    aggregates_.build(matrix);
    component_ = matrix.component;
  }
  if (aggregates_.count() == 0) return false;
  if (cut || matrix.version != version_) index(matrix);
  find_frames(matrix);
  for_each(aggregates_.count(), [&](int a) { sum_columns(matrix, a); }, 1);
  return factorize();
}

// Finds the sum of each block, and the pattern of Z^T A Z.
void RigidMotions::index(const BlockMatrix& matrix) {
  version_ = matrix.version;
  const int count = aggregates_.count();
  std::vector<std::vector<int>> rows(count);  // aggregates coupled to each one: few
  for (int a = 0; a < count; ++a) rows[a].push_back(a);
  const auto for_each_coupling = [&](const auto& body) {
    for (int c = 0; c < matrix.columns(); ++c)
      for (int k = matrix.column_start[c]; k < matrix.column_start[c + 1]; ++k)
        if (const int a = aggregates_.of[c], b = aggregates_.of[matrix.row[k]]; a >= 0 && b >= 0) body(k, a, b);
  };
  for_each_coupling([&](int, int a, int b) {
    if (a == b || std::find(rows[a].begin(), rows[a].end(), b) != rows[a].end()) return;
    rows[a].push_back(b);
    rows[b].push_back(a);
  });
  sum_start_.assign(1, 0);
  sums_.clear();
  for (std::vector<int>& of_piece : rows) {
    std::sort(of_piece.begin(), of_piece.end());
    for (const int b : of_piece) sums_.push_back({b, -1, Mat6::Zero()});
    sum_start_.push_back(static_cast<int>(sums_.size()));
  }
  const auto find = [&](int a, int b) {
    return sum_start_[a] + static_cast<int>(std::lower_bound(rows[a].begin(), rows[a].end(), b) - rows[a].begin());
  };
  for (int a = 0; a < count; ++a)
    for (int s = sum_start_[a]; s < sum_start_[a + 1]; ++s) sums_[s].mirror = find(sums_[s].row, a);
  sum_of_.assign(matrix.row.size(), -1);
  for_each_coupling([&](int k, int a, int b) { sum_of_[k] = find(a, b); });

  std::vector<Eigen::Triplet<double>> entries;
  for (int a = 0; a < count; ++a)
    for (int s = find(a, a); s < sum_start_[a + 1]; ++s)
      for (int j = 0; j < 6; ++j)
        for (int i = sums_[s].row == a ? j : 0; i < 6; ++i) entries.emplace_back(6 * sums_[s].row + i, 6 * a + j, 1.0);
  coarse_.resize(6 * count, 6 * count);
  coarse_.setFromTriplets(entries.begin(), entries.end());
  factor_.analyzePattern(coarse_);
}

void RigidMotions::find_frames(const BlockMatrix& matrix) {
  rotations_.resize(aggregates_.count());
  arms_.setZero(3, matrix.columns());
  for_each(aggregates_.count(), [&](int a) {
    const int first = aggregates_.start[a], last = aggregates_.start[a + 1];
    Vec3 centre = Vec3::Zero();
    for (int i = first; i < last; ++i) centre += matrix.positions.segment<3>(3 * aggregates_.column[i]);
    centre /= last - first;
    Mat3 inertia = Mat3::Zero();
    for (int i = first; i < last; ++i) {
      const Vec3 arm = matrix.positions.segment<3>(3 * aggregates_.column[i]) - centre;
      arms_.col(aggregates_.column[i]) = arm;
      inertia += arm.squaredNorm() * Mat3::Identity() - arm * arm.transpose();
    }
    const Eigen::SelfAdjointEigenSolver<Mat3> axes(inertia / (last - first));
    const Vec3& squares = axes.eigenvalues();
    for (int j = 0; j < 3; ++j)
      rotations_[a].col(j) = squares(j) > slender * squares(2) ? Vec3(axes.eigenvectors().col(j) / std::sqrt(squares(j))) : Vec3::Zero();
  }, 8);
}

// Sums blocks on one side of the diagonal, and half of those on it; coarse_ adds the mirror image.
void RigidMotions::sum_columns(const BlockMatrix& matrix, int aggregate) {
  const int begin = sum_start_[aggregate], end = sum_start_[aggregate + 1];
  struct Product {
    BlockLanes force, moment;  // transposed motions of rows times blocks of one column
    // With the motions of all columns as well.
    BlockLanes moved_force, moved_moment, turned_force, turned_moment;
  };
  std::vector<Product> products(end - begin);
  std::vector<int> touched;
  for (int i = aggregates_.start[aggregate]; i < aggregates_.start[aggregate + 1]; ++i) {
    const int c = aggregates_.column[i];
    touched.clear();
    for (int k = matrix.column_start[c]; k < matrix.column_start[c + 1]; ++k) {
      if (sum_of_[k] < 0) continue;
      const int s = sum_of_[k] - begin, r = matrix.row[k];
      if (std::find(touched.begin(), touched.end(), s) == touched.end()) {
        touched.push_back(s);
        products[s].force = products[s].moment = BlockLanes();
      }
      BlockLanes block(matrix.values.data() + 9 * static_cast<std::ptrdiff_t>(k));
      if (r == c) block *= 0.5;
      products[s].force += block;
      products[s].moment += block.crossed_by(load3(arms_.col(r).data()));
    }
    const Lanes arm = load3(arms_.col(c).data());
    for (const int s : touched) {
      Product& product = products[s];
      product.moved_force += product.force;
      product.moved_moment += product.moment;
      product.turned_force += product.force.times_cross(arm);
      product.turned_moment += product.moment.times_cross(arm);
    }
  }
  for (int s = begin; s < end; ++s) {
    const Product& product = products[s - begin];
    Mat6& value = sums_[s].value;
    value << matrix3(product.moved_force), -matrix3(product.turned_force), matrix3(product.moved_moment), -matrix3(product.turned_moment);
  }
  for (int s = begin; s < end; ++s) {
    Mat6& value = sums_[s].value;
    value.bottomRows<3>() = (rotations_[sums_[s].row].transpose() * value.bottomRows<3>()).eval();
    value.rightCols<3>() = (value.rightCols<3>() * rotations_[aggregate]).eval();
  }
}

bool RigidMotions::factorize() {
  for_each(aggregates_.count(), [&](int a) {
    const int own = static_cast<int>(std::lower_bound(sums_.begin() + sum_start_[a], sums_.begin() + sum_start_[a + 1], a,
                                                      [](const Sum& s, int aggregate) { return s.row < aggregate; }) - sums_.begin());
    for (int j = 0; j < 6; ++j) {
      double* to = coarse_.valuePtr() + coarse_.outerIndexPtr()[6 * a + j];
      for (int s = own; s < sum_start_[a + 1]; ++s) {
        const Mat6& value = sums_[s].value;
        const Mat6& mirrored = sums_[sums_[s].mirror].value;
        for (int i = s == own ? j : 0; i < 6; ++i) *to++ = value(i, j) + mirrored(j, i);
      }
      double& diagonal = coarse_.valuePtr()[coarse_.outerIndexPtr()[6 * a + j]];
      diagonal = diagonal == 0 ? 1 : (1 + shift) * diagonal;  // 1: a rotation that was left out
    }
  }, 8);
  factor_.factorize(coarse_);
  return factor_.info() == Eigen::Success;
}

double RigidMotions::add(const VecX& r, VecX& z) {
  moments_.resize(6 * static_cast<Eigen::Index>(aggregates_.count()));
  for_each(aggregates_.count(), [&](int a) {
    Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
    for (int i = aggregates_.start[a]; i < aggregates_.start[a + 1]; ++i) {
      const int c = aggregates_.column[i];
      const Vec3 at = r.segment<3>(3 * c);
      force += at;
      moment += arms_.col(c).cross(at);
    }
    moments_.segment<6>(6 * a) << force, rotations_[a].transpose() * moment;
  }, 8);
  const VecX motions = factor_.solve(moments_);
  for_each(aggregates_.count(), [&](int a) {
    const Vec3 shift = motions.segment<3>(6 * a), turn = rotations_[a] * motions.segment<3>(6 * a + 3);
    for (int i = aggregates_.start[a]; i < aggregates_.start[a + 1]; ++i) {
      const int c = aggregates_.column[i];
      z.segment<3>(3 * c) += shift + turn.cross(Vec3(arms_.col(c)));
    }
  }, 8);
  return moments_.dot(motions);
}

}  // namespace tack
