// The elimination tree's cut, and factors large enough to have a parallel top.
#include <catch2/catch.hpp>
#include <tbb/global_control.h>

#include "framework/core/linear_solver.hpp"
#include "solvers/linear/cholmod_analysis.hpp"
#include "solvers/linear/supernode_tree.hpp"
#include "tests/support/component_variants.hpp"
#include "tests/support/random_blocks.hpp"

using namespace tack;

namespace {

VecX solution(const std::string& yaml, const BlockMatrix& matrix, const VecX& b, int threads = 2) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
  const auto solver = component<LinearSolver>(yaml);
  PhaseClock clock;
  REQUIRE(solver->factorize(matrix, clock));
  VecX x;
  solver->solve(b, x, clock);
  return x;
}

}  // namespace

TEST_CASE("subtrees and top are each node once, parents after children", "[linear]") {
  RandomMotions random(1);
  for (const int n : {2, 5, 12}) {
    const BlockMatrix matrix = grid(n, random);
    CholmodAnalysis analysis;
    REQUIRE(analysis.update(matrix, CholmodAnalysis::Kind::supernodal_blocks));
    const SupernodeTree tree(*analysis.factor(), matrix);
    std::vector<int> seen(tree.nodes(), 0), owner(tree.nodes(), -1);
    for (size_t i = 0; i < tree.subtrees.size(); ++i)
      for (int s = tree.subtrees[i].first; s <= tree.subtrees[i].root; ++s) {
        ++seen[s];
        owner[s] = static_cast<int>(i);
      }
    for (const int s : tree.top) ++seen[s];
    CHECK(std::all_of(seen.begin(), seen.end(), [](int k) { return k == 1; }));
    for (int s = 0; s < tree.nodes(); ++s) {
      if (tree.parent[s] < 0) continue;
      CHECK(tree.parent[s] > s);
      // A child of a subtree's node is in that subtree.
      if (owner[tree.parent[s]] >= 0) CHECK(owner[s] == owner[tree.parent[s]]);
      for (int k = tree.row_start[s] + tree.columns(s); k < tree.row_start[s + 1]; ++k)
        CHECK(tree.rows[tree.row_start[tree.parent[s]] + tree.position[k]] == tree.rows[k]);
    }
    if (n == 12) CHECK((tree.subtrees.size() > 4 && !tree.top.empty()));
  }
}

TEST_CASE("multifrontal solutions are CHOLMOD's", "[linear]") {
  RandomMotions random(2);
  for (const double stiffest : {1.0, 1e4}) {
    const BlockMatrix matrix = grid(12, random, stiffest);
    const VecX b = random.vectors(matrix.size());
    const VecX reference = solution("cholmod", matrix, b);
    const auto error = [&](const std::string& yaml) {
      return (solution(yaml, matrix, b) - reference).norm() / reference.norm();
    };
    CHECK(error("multifrontal") < 1e-12 * std::max(1.0, stiffest));
    CHECK(error("{type: multifrontal, precision: single}") < 1e-5 * std::max(1.0, stiffest));
    CHECK(error("{type: multifrontal, precision: single}") > 1e-12);  // it is single
    CHECK(error("{type: lagged_cholesky, tolerance: 1e-10}") < 1e-6);
  }
}

TEST_CASE("multifrontal solutions have the same bits for 1, 2 and 4 threads", "[linear]") {
  RandomMotions random(3);
  const BlockMatrix matrix = grid(12, random);
  const VecX b = random.vectors(matrix.size());
  for (const char* precision : {"single", "double"}) {
    const std::string yaml = std::string("{type: multifrontal, precision: ") + precision + "}";
    for (const int threads : {2, 4}) CHECK((solution(yaml, matrix, b, 1) == solution(yaml, matrix, b, threads)));
  }
}

// Single precision cannot factorise this; the solver turns to double by itself.
TEST_CASE("a lagged factor is refined where single precision is not enough", "[linear]") {
  RandomMotions random(4);
  const BlockMatrix matrix = grid(6, random, 1e9);
  const VecX b = random.vectors(matrix.size());
  VecX product;
  matrix.multiply(solution("lagged_cholesky", matrix, b), product);
  CHECK((product - b).norm() / b.norm() < 1e-2);
}
