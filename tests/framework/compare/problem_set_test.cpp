// Hard steps of the experiments, stored in tests/data/problems (store_problems.sh). Each is
// minimised with every projection of the Hessian:
// - the projection `clamp` takes hardly more iterations than the best
// - all find the same minimum, or another known one
// Iteration counts are compared on one machine: they depend on round-off.
#include <algorithm>
#include <catch2/catch.hpp>
#include <map>

#include "framework/compare/reference.hpp"
#include "framework/config/parse.hpp"

using namespace tack;

namespace {

struct StoredProblem {
  const char* name;
  bool branches = false;  // there is more than one minimum nearby
};

const std::vector<StoredProblem> problems = {
    {"arch_collapse", true}, {"compression"},    {"contrast"}, {"debonding"},      {"debonding_front"},
    {"folding"},             {"impact"},         {"large_step"}, {"parallel_edges"}, {"sliding"},
    {"sticky_sliding"},      {"sticky_wall"},    {"twist"},
};

}  // namespace

TEST_CASE("hard steps converge to a known minimum with every projection, within their bounds", "[compare][problems]") {
  for (const StoredProblem& stored : problems) {
    INFO(stored.name);
    const CompareCase compare_case = problem_case(std::string(TACK_TEST_DATA "/problems/") + stored.name + ".problem");
    const Reference reference = make_reference(compare_case, compare_case.step_size, 1e-9, 1e-7);
    REQUIRE(reference.exists());
    if (!stored.branches) CHECK_FALSE(reference.other_branch);
    std::map<std::string, int> iterations;
    for (const char* projection : {"clamp", "absolute", "on_demand"}) {
      INFO(projection);
      Trial trial(compare_case, {parse_string(std::string("{projection: ") + projection + "}", "(test)"), 1e-5, compare_case.step_size});
      trial.record();
      const TrialResult& result = trial.run();
      REQUIRE_FALSE(trial.history().empty());
      if (!compare_case.quasi_static) CHECK(trial.history().back().residual <= 1);
      CHECK(result.status == "converged");
      CHECK(result.intersections == 0);
      iterations[projection] = result.iterations;
      const Branch branch = branch_of(compare_case, reference, compare_case.step_size, result.x);
      if (!stored.branches) CHECK(branch.kind != Branch::Kind::another);
      CHECK(largest_distance(trial.world(), result.x, branch.x) < 1e-3 * compare_case.size);
    }
    const int fewest = std::min({iterations["clamp"], iterations["absolute"], iterations["on_demand"]});
    INFO("clamp " << iterations["clamp"] << ", absolute " << iterations["absolute"] << ", on demand "
                  << iterations["on_demand"]);
    CHECK(iterations["clamp"] <= 2 * fewest + 5);
    CHECK(iterations["clamp"] <= 200);  // the limit is 500
  }
}
