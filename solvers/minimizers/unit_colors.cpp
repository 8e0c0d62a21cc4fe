#include "solvers/minimizers/unit_colors.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <limits>
#include <numeric>

#include "geometry/parallel.hpp"

namespace tack {
namespace {

constexpr int blocks_max = 4;  // of a unit with a dense system of its own

Eigen::Index first_of(int block) { return 3 * static_cast<Eigen::Index>(block); }

// Returns the unit of each block, numbered 0, 1, ... in the order of their first blocks.
std::vector<int> units_of_blocks(const MinimizerProblem& problem, int blocks) {
  std::vector<int> given(blocks);
  if (problem.motion_units) given = problem.motion_units();
  else std::iota(given.begin(), given.end(), 0);
  std::vector<int> size(blocks, 0), number(blocks, -1), unit(blocks);
  for (const int u : given) ++size[u];
  int count = 0;
  for (int b = 0; b < blocks; ++b) {
    int& known = number[given[b]];
    if (known < 0 || size[given[b]] > blocks_max) known = count++;
    unit[b] = known;
  }
  return unit;
}

}  // namespace

UnitColors::UnitColors(const MinimizerProblem& problem, const BlockMatrix& hessian) {
  const int blocks = hessian.columns();
  const std::vector<int> unit = units_of_blocks(problem, blocks);
  const int count = blocks == 0 ? 0 : 1 + *std::max_element(unit.begin(), unit.end());
  std::vector<std::vector<int>> members(count), neighbours(count);
  for (int c = 0; c < blocks; ++c) {
    members[unit[c]].push_back(c);
    for (int k = hessian.column_start[c]; k < hessian.column_start[c + 1]; ++k) {
      const int a = unit[c], b = unit[hessian.row[k]];
      if (a == b) continue;
      neighbours[a].push_back(b);
      neighbours[b].push_back(a);
    }
  }
  std::vector<int> color(count, -1), taken_by;  // taken_by: the last unit with a neighbour of each colour
  for (int u = 0; u < count; ++u) {
    for (const int v : neighbours[u])
      if (color[v] >= 0) taken_by[color[v]] = u;
    const auto free = std::find_if(taken_by.begin(), taken_by.end(), [u](int by) { return by != u; });
    color[u] = static_cast<int>(free - taken_by.begin());
    if (free == taken_by.end()) taken_by.push_back(-1);
  }
  sets.resize(taken_by.size());
  colors_.resize(taken_by.size());
  std::vector<int> place(count, -1);  // of a unit in its colour
  for (int b = 0; b < blocks; ++b) {
    const int u = unit[b];
    Color& own = colors_[color[u]];
    if (place[u] < 0) {
      place[u] = static_cast<int>(own.units.size());
      own.units.emplace_back();
    }
    own.unit_of.push_back(place[u]);
    own.place_in_unit.push_back(static_cast<int>(own.units[place[u]].size()));
    own.units[place[u]].push_back(static_cast<int>(sets[color[u]].size()));
    sets[color[u]].push_back(b);
  }
}

VecX UnitColors::newton_steps(size_t c, const BlockMatrix& hessian, const VecX& gradient) const {
  const Color& color = colors_[c];
  VecX p(gradient.size());
  for_each(static_cast<int>(color.units.size()), [&](int u) {
    const std::vector<int>& blocks = color.units[u];
    const auto n = static_cast<Eigen::Index>(3 * blocks.size());
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 3 * blocks_max, 3 * blocks_max> own(n, n);
    Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 3 * blocks_max, 1> right(n);
    own.setZero();
    for (size_t i = 0; i < blocks.size(); ++i) {
      right.segment<3>(first_of(static_cast<int>(i))) = -gradient.segment<3>(first_of(blocks[i]));
      for (int k = hessian.column_start[blocks[i]]; k < hessian.column_start[blocks[i] + 1]; ++k)
        if (const int r = hessian.row[k]; color.unit_of[r] == u) own.block<3, 3>(first_of(color.place_in_unit[r]), first_of(static_cast<int>(i))) = hessian.block(k);
    }
    // Semi-definite: a vertex that nothing holds in some direction.
    constexpr double shift = 1e-10;
    own.diagonal().array() += shift * own.diagonal().cwiseAbs().maxCoeff();
    if (!own.allFinite()) right.setConstant(std::numeric_limits<double>::quiet_NaN());
    else if (!right.isZero(0)) right = own.ldlt().solve(right).eval();
    for (size_t i = 0; i < blocks.size(); ++i) p.segment<3>(first_of(blocks[i])) = right.segment<3>(first_of(static_cast<int>(i)));
  }, 64);
  return p;
}

void UnitColors::halve_overshooting(size_t c, const VecX& gradient, VecX& p) const {
  bool any = false;
  for (const std::vector<int>& blocks : colors_[c].units) {
    double slope = 0;
    for (const int b : blocks) slope += gradient.segment<3>(first_of(b)).dot(p.segment<3>(first_of(b)));
    if (!(slope > 0)) continue;
    any = true;
    for (const int b : blocks) p.segment<3>(first_of(b)) *= 0.5;
  }
  if (!any) p *= 0.5;
}

void UnitColors::scatter(size_t c, const VecX& own, VecX& all) const {
  for (size_t i = 0; i < sets[c].size(); ++i) all.segment<3>(first_of(sets[c][i])) = own.segment<3>(first_of(static_cast<int>(i)));
}

}  // namespace tack
