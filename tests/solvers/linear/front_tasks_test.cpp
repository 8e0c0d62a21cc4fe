// Nodes of a multifrontal factor that are cut into tiles, for columns around the tiles' borders.
#include <catch2/catch.hpp>
#include <tbb/global_control.h>

#include <algorithm>
#include <optional>
#include <set>
#include <tuple>

#include "framework/core/linear_solver.hpp"
#include "solvers/linear/cholmod_analysis.hpp"
#include "solvers/linear/supernode_tree.hpp"
#include "tests/support/component_variants.hpp"
#include "tests/support/random_blocks.hpp"

using namespace tack;

namespace {

// Couples all pairs of vertices [first, first + count), and these with [others, others + other_count).
void couple(std::vector<std::set<int>>& rows, int first, int count, int others, int other_count) {
  const auto add = [&](int i, int j) { rows[std::min(i, j)].insert(std::max(i, j)); };
  for (int i = first; i < first + count; ++i) {
    for (int j = i; j < first + count; ++j) add(i, j);
    for (int j = others; j < others + other_count; ++j) add(i, j);
  }
}

// Two cliques of `clique` vertices, each coupled to four cliques of 20 vertices and to two thirds of a
// separator of `separator` vertices: the elimination tree has three large nodes above its leaves.
BlockMatrix cliques(int clique, int separator, RandomMotions& random) {
  static std::uint64_t versions = 1u << 24;
  constexpr int leaf = 20, leaves = 4;
  const int group = leaves * leaf + clique, last = 2 * group;
  std::vector<std::set<int>> rows(last + separator);
  for (int g = 0; g < 2; ++g) {
    const int own = g * group + leaves * leaf;
    for (int l = 0; l < leaves; ++l) couple(rows, g * group + l * leaf, leaf, own + l * clique / 8, clique / 2);
    couple(rows, own, clique, last + g * separator / 3, 2 * separator / 3);
  }
  couple(rows, last, separator, last, 0);
  BlockMatrix matrix;
  matrix.version = ++versions;
  matrix.column_start.push_back(0);
  for (const std::set<int>& column : rows) {
    matrix.row.insert(matrix.row.end(), column.begin(), column.end());
    matrix.column_start.push_back(static_cast<int>(matrix.row.size()));
  }
  matrix.values.assign(9 * matrix.row.size(), 0.0);
  for (int c = 0; c < matrix.columns(); ++c) {
    matrix.block(matrix.column_start[c]).diagonal().array() += 1;
    for (int e = matrix.column_start[c] + 1; e < matrix.column_start[c + 1]; ++e) {
      const Mat3 root = Mat3::NullaryExpr([&] { return random.uniform(-1, 1); });
      const Mat3 spring = root * root.transpose();
      matrix.block(e) = -spring;
      matrix.block(matrix.column_start[c]) += spring;
      matrix.block(matrix.column_start[matrix.row[e]]) += spring;
    }
  }
  return matrix;
}

SupernodeTree tree_of(const BlockMatrix& matrix) {
  CholmodAnalysis analysis;
  REQUIRE(analysis.update(matrix, CholmodAnalysis::Kind::supernodal_blocks));
  return SupernodeTree(*analysis.factor(), matrix);
}

int count(const FrontTasks& tasks, FrontTask::Kind kind) {
  return static_cast<int>(std::count_if(tasks.tasks.begin(), tasks.tasks.end(), [&](const FrontTask& t) { return t.kind == kind; }));
}

std::optional<VecX> solution(const char* precision, const BlockMatrix& matrix, const VecX& b, int threads) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
  const auto solver = component<LinearSolver>(std::string("{type: multifrontal, precision: ") + precision + "}");
  PhaseClock clock;
  if (!solver->factorize(matrix, clock)) return std::nullopt;
  VecX x;
  solver->solve(b, x, clock);
  return x;
}

// Vertices: three of them are 9 columns, so that nodes end before, at and after borders of tiles.
constexpr int clique_sizes[] = {31, 32, 33, 42, 43, 63, 64, 65, 85, 86};

}  // namespace

TEST_CASE("factors in tiles solve as a dense factor does, with the same bits for 1, 2 and 4 threads", "[linear]") {
  RandomMotions random(11);
  for (const int size : clique_sizes) {
    CAPTURE(size);
    const BlockMatrix matrix = cliques(size, 96, random);
    const SupernodeTree tree = tree_of(matrix);
    CHECK(count(tree.factor_tasks, FrontTask::Kind::panel) > 5);
    CHECK(count(tree.factor_tasks, FrontTask::Kind::update) > 1);
    CHECK(count(tree.solve_tasks, FrontTask::Kind::lower) > 1);
    CHECK(count(tree.solve_tasks, FrontTask::Kind::lower) == count(tree.solve_tasks, FrontTask::Kind::transposed));
    const VecX b = random.vectors(matrix.size());
    const VecX reference = dense(matrix).ldlt().solve(b);
    for (const auto& [precision, error] : {std::pair{"double", 1e-12}, {"single", 2e-4}}) {
      const VecX x = solution(precision, matrix, b, 1).value();
      CHECK((x - reference).norm() < error * reference.norm());
      for (const int threads : {2, 4}) CHECK((solution(precision, matrix, b, threads).value() == x));
    }
  }
}

TEST_CASE("a factor in tiles finds any column that is not definite", "[linear]") {
  RandomMotions random(12);
  const BlockMatrix matrix = cliques(64, 96, random);
  const VecX b = random.vectors(matrix.size());
  REQUIRE(solution("double", matrix, b, 2));
  for (int c = 0; c + 1 < matrix.columns(); c += 7) {
    CAPTURE(c);
    BlockMatrix broken = matrix;
    const int diagonal = broken.column_start[c], beside = diagonal + 1;
    REQUIRE(beside < broken.column_start[c + 1]);
    const double other = broken.block(broken.column_start[broken.row[beside]])(0, 0);
    broken.block(beside)(0, 0) = 1.01 * std::sqrt(broken.block(diagonal)(0, 0) * other);  // larger than both pivots allow
    for (const int threads : {1, 2}) CHECK(!solution("double", broken, b, threads));
  }
}

TEST_CASE("tasks of a factor wait for earlier ones, and each tile is computed once", "[linear]") {
  RandomMotions random(13);
  const SupernodeTree tree = tree_of(cliques(86, 96, random));
  for (const FrontTasks* tasks : {&tree.factor_tasks, &tree.solve_tasks}) {
    REQUIRE(tasks->order.chunks() == static_cast<int>(tasks->tasks.size()));
    for (int c = 0; c < tasks->order.chunks(); ++c)
      for (int k = tasks->order.start[c]; k < tasks->order.start[c + 1]; ++k) CHECK(tasks->order.before[k] < c);
    std::set<std::tuple<FrontTask::Kind, int, int, int>> seen;
    for (const FrontTask& t : tasks->tasks) CHECK(seen.insert({t.kind, t.node, t.row, t.column}).second);
  }
  for (const int s : tree.top) {
    const FrontTiles tiles = FrontTiles::of_factor(tree.columns(s), tree.height(s));
    CHECK(tiles.begin(0) == 0);
    CHECK(tiles.end(tiles.count - 1) == tiles.height);
    for (int i = 1; i < tiles.count; ++i) CHECK(tiles.begin(i) == tiles.end(i - 1));
  }
}
