#include "solvers/linear/aggregates.hpp"

#include <Eigen/Eigenvalues>

#include <algorithm>

#include "solvers/linear/component_sizes.hpp"

namespace tack {
namespace {

constexpr int flat_size = 20;       // vertices of an aggregate of a sheet or rod
constexpr int flat_count = 2000;  // largest number of flat aggregates; aggregates of larger systems are larger
constexpr int solid_size = 250;     // vertices of an aggregate of a solid
// Limit of their number, which 400 000 vertices reach: the factor of their motions grows faster than the system.
constexpr int solid_count = 1600;
constexpr int fragment = 3;  // an aggregate smaller than its size by this factor joins a neighbour
constexpr double flat = 0.02;       // square of thickness over width

// Couplings within components, in both directions.
struct Neighbours {
  explicit Neighbours(const BlockMatrix& matrix) : start(matrix.columns() + 1, 0) {
    const auto for_each_pair = [&](const auto& body) {
      for (int c = 0; c < matrix.columns(); ++c)
        for (int k = matrix.column_start[c] + 1; k < matrix.column_start[c + 1]; ++k)
          if (matrix.component[matrix.row[k]] == matrix.component[c]) body(matrix.row[k], c);
    };
    for_each_pair([&](int r, int c) { ++start[r + 1], ++start[c + 1]; });
    for (int c = 0; c < matrix.columns(); ++c) start[c + 1] += start[c];
    of.resize(start.back());
    auto next = start;
    for_each_pair([&](int r, int c) { of[next[r]++] = c, of[next[c]++] = r; });
  }
  std::vector<int> start, of;
};

bool is_flat(const BlockMatrix& matrix, const std::vector<int>& columns) {
  Vec3 centre = Vec3::Zero();
  for (const int c : columns) centre += matrix.positions.segment<3>(3 * c) / static_cast<double>(columns.size());
  Mat3 spread = Mat3::Zero();
  for (const int c : columns) {
    const Vec3 arm = matrix.positions.segment<3>(3 * c) - centre;
    spread += arm * arm.transpose();
  }
  const Vec3 squares = Eigen::SelfAdjointEigenSolver<Mat3>(spread, Eigen::EigenvaluesOnly).eigenvalues();
  return !(squares(0) > flat * squares(2));
}

}  // namespace

void Aggregates::build(const BlockMatrix& matrix) {
  const int n = matrix.columns();
  const Neighbours neighbours(matrix);
  const std::vector<int> component_size = component_sizes(matrix);
  const size_t flat_limit = std::max(flat_size, n / flat_count), solid_limit = std::max(solid_size, n / solid_count);

  of.assign(n, -1);
  std::vector<int> size, aggregate;
  for (int seed = 0; seed < n; ++seed) {
    if (of[seed] >= 0 || component_size[matrix.component[seed]] < smallest_component) continue;
    const int number = static_cast<int>(size.size());
    aggregate.assign(1, seed);
    of[seed] = number;
    size_t limit = flat_limit;
    for (size_t i = 0; i < aggregate.size(); ++i) {
      for (int k = neighbours.start[aggregate[i]]; k < neighbours.start[aggregate[i] + 1]; ++k) {
        if (of[neighbours.of[k]] >= 0 || aggregate.size() >= limit) continue;
        of[neighbours.of[k]] = number;
        aggregate.push_back(neighbours.of[k]);
        if (aggregate.size() == flat_limit && !is_flat(matrix, aggregate)) limit = solid_limit;
      }
    }
    int other = -1;
    if (fragment * aggregate.size() < limit) {
      for (const int c : aggregate)
        for (int k = neighbours.start[c]; k < neighbours.start[c + 1]; ++k)
          if (const int at = of[neighbours.of[k]]; at >= 0 && at != number && (other < 0 || size[at] < size[other])) other = at;
    }
    if (other < 0) {
      size.push_back(static_cast<int>(aggregate.size()));
    } else {
      for (const int c : aggregate) of[c] = other;
      size[other] += static_cast<int>(aggregate.size());
    }
  }

  start.assign(size.size() + 1, 0);
  for (size_t a = 0; a < size.size(); ++a) start[a + 1] = start[a] + size[a];
  column.resize(start.back());
  auto next = start;
  for (int c = 0; c < n; ++c)
    if (of[c] >= 0) column[next[of[c]]++] = c;
}

}  // namespace tack
