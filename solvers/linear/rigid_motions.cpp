#include "solvers/linear/rigid_motions.hpp"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <utility>

#include "framework/core/lanes.hpp"
#include "geometry/parallel.hpp"
#include "solvers/linear/dense_kernels.hpp"

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

bool RigidMotions::update(const BlockMatrix& matrix, const Deadline& deadline) {
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
  fill_coarse_matrix();
  blas::set_threads(1);
  if (analysis_.update(coarse_, CholmodAnalysis::Kind::supernodal_blocks)) tree_.emplace(*analysis_.factor(), coarse_);
  return factor_.factorize(*tree_, coarse_, deadline);
}

// Finds the sum of each block, and the pattern of Z^T A Z.
void RigidMotions::index(const BlockMatrix& matrix) {
  version_ = matrix.version;
  const int count = aggregates_.count();
  std::vector<std::vector<int>> below(count), rows(count);  // aggregates coupled to each one: few
  const auto make_unique = [](std::vector<int>& numbers) {
    std::sort(numbers.begin(), numbers.end());
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  };
  for_each(count, [&](int a) {
    for (int i = aggregates_.start[a]; i < aggregates_.start[a + 1]; ++i) {
      const int c = aggregates_.column[i];
      for (int k = matrix.column_start[c]; k < matrix.column_start[c + 1]; ++k)
        if (const int b = aggregates_.of[matrix.row[k]]; b >= 0 && (below[a].empty() || below[a].back() != b)) below[a].push_back(b);
    }
    make_unique(below[a]);
  }, 1);
  for (int a = 0; a < count; ++a)
    for (const int b : below[a]) {
      rows[a].push_back(b);
      rows[b].push_back(a);
    }
  sum_start_.assign(1, 0);
  sums_.clear();
  for (std::vector<int>& of_aggregate : rows) {
    make_unique(of_aggregate);
    for (const int b : of_aggregate) sums_.push_back({b, -1, Mat6::Zero()});
    sum_start_.push_back(static_cast<int>(sums_.size()));
  }
  const auto find = [&](int a, int b) {
    return sum_start_[a] + static_cast<int>(std::lower_bound(rows[a].begin(), rows[a].end(), b) - rows[a].begin());
  };
  for (int a = 0; a < count; ++a)
    for (int s = sum_start_[a]; s < sum_start_[a + 1]; ++s) sums_[s].mirror = find(sums_[s].row, a);
  sum_of_.resize(matrix.row.size());
  for_each(matrix.columns(), [&](int c) {
    const int a = aggregates_.of[c];
    for (int k = matrix.column_start[c]; k < matrix.column_start[c + 1]; ++k) {
      const int b = aggregates_.of[matrix.row[k]];
      sum_of_[k] = a >= 0 && b >= 0 ? find(a, b) : -1;
    }
  }, 512);
  list_coarse_blocks();
}

void RigidMotions::list_coarse_blocks() {
  ++coarse_.version;
  coarse_.row.clear();
  coarse_.column_start.assign(1, 0);
  for (int a = 0; a < aggregates_.count(); ++a)
    for (int half = 0; half < 2; ++half) {
      for (int s = sum_start_[a]; s < sum_start_[a + 1]; ++s)
        for (int row = 2 * sums_[s].row; row < 2 * sums_[s].row + 2; ++row)
          if (row >= 2 * a + half) coarse_.row.push_back(row);
      coarse_.column_start.push_back(static_cast<int>(coarse_.row.size()));
    }
  coarse_.values.resize(9 * coarse_.row.size());
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

void RigidMotions::fill_coarse_matrix() {
  for_each(aggregates_.count(), [&](int a) {
    for (int half = 0; half < 2; ++half) {
      const int column = 2 * a + half;
      int k = coarse_.column_start[column];
      for (int s = sum_start_[a]; s < sum_start_[a + 1]; ++s) {
        const Mat6& value = sums_[s].value;
        const Mat6& mirrored = sums_[sums_[s].mirror].value;
        for (int i = 0; i < 2; ++i)
          if (2 * sums_[s].row + i >= column)
            coarse_.block(k++) = value.block<3, 3>(3 * i, 3 * half) + mirrored.block<3, 3>(3 * half, 3 * i).transpose();
      }
      auto own = coarse_.block(coarse_.column_start[column]);
      for (int j = 0; j < 3; ++j) own(j, j) = own(j, j) == 0 ? 1 : (1 + shift) * own(j, j);  // 1: a rotation that was left out
    }
  }, 8);
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
  }, 2);
  factor_.solve(moments_, motions_);
  for_each(aggregates_.count(), [&](int a) {
    const Vec3 shift = motions_.segment<3>(6 * a), turn = rotations_[a] * motions_.segment<3>(6 * a + 3);
    for (int i = aggregates_.start[a]; i < aggregates_.start[a + 1]; ++i) {
      const int c = aggregates_.column[i];
      z.segment<3>(3 * c) += shift + turn.cross(Vec3(arms_.col(c)));
    }
  }, 2);
  return moments_.dot(motions_);
}

}  // namespace tack
