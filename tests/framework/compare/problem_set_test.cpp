// Hard steps of the experiments, stored in tests/data/problems (store_problems.sh). Each is
// minimised with every projection of the Hessian:
// - the default one takes hardly more iterations than the best
// - all find the same minimum, or another one that is known to exist
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
  bool branches = false;  // more than one minimum is in reach
};

const std::vector<StoredProblem> problems = {
    {"arch_collapse", true}, {"compression"},    {"contrast"}, {"debonding"},      {"debonding_front"},
    {"folding"},             {"impact"},         {"large_step"}, {"parallel_edges"}, {"sliding"},
    {"sticky_sliding"},      {"sticky_wall"},    {"twist"},
};

}  // namespace

TEST_CASE("hard steps converge within their bounds, with every projection to a minimum that is known", "[compare][problems]") {
  for (const StoredProblem& stored : problems) {
    INFO(stored.name);
    const CompareCase compared = problem_case(std::string(TACK_TEST_DATA "/problems/") + stored.name + ".problem");
    const Reference reference = make_reference(compared, compared.step_size, 1e-9, 1e-7);
    REQUIRE(reference.exists());
    if (!stored.branches) CHECK_FALSE(reference.other_branch);
    std::map<std::string, int> iterations;
    for (const char* projection : {"clamp", "absolute", "on_demand"}) {
      INFO(projection);
      Trial trial(compared, {parse_string(std::string("{projection: ") + projection + "}", "(test)"), 1e-5, compared.step_size});
      trial.record();
      const TrialResult& result = trial.run();
      REQUIRE_FALSE(trial.history().empty());
      if (!compared.quasi_static) CHECK(trial.history().back().residual <= 1);
      CHECK(result.status == "converged");
      CHECK(result.intersections == 0);
      iterations[projection] = result.iterations;
      const Branch branch = branch_of(compared, reference, compared.step_size, result.x);
      if (!stored.branches) CHECK(branch.kind != Branch::Kind::another);
      CHECK(largest_distance(trial.world(), result.x, branch.x) < 1e-3 * compared.size);
    }
    const int fewest = std::min({iterations["clamp"], iterations["absolute"], iterations["on_demand"]});
    INFO("clamp " << iterations["clamp"] << ", absolute " << iterations["absolute"] << ", on demand "
                  << iterations["on_demand"]);
    CHECK(iterations["clamp"] <= 2 * fewest + 5);
    CHECK(iterations["clamp"] <= 200);  // of 500 that it may take: none is close to giving up
  }
}
