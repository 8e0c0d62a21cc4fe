// Hard steps of the experiments, stored in tests/data/problems (store_problems.sh): each is minimised within a
// number of iterations, half as many again as it took when it was stored, and all filters of the Hessian
// come to the same minimum, or to another one that is known to exist.
#include <catch2/catch.hpp>

#include "framework/compare/reference.hpp"
#include "framework/config/parse.hpp"

using namespace tack;

namespace {

struct StoredProblem {
  const char* name;
  int most_iterations;  // with the default filter, to 1e-5 m/s
  bool branches = false;  // more than one minimum is in reach
};

const std::vector<StoredProblem> problems = {
    {"arch_collapse", 72, true},
    {"compression", 21},
    {"contrast", 15},
    {"debonding", 18},
    {"debonding_front", 47},
    {"folding", 8},
    {"impact", 18},
    {"large_step", 18},
    {"parallel_edges", 9},
    {"sliding", 5},
    {"sticky_sliding", 5},
    {"sticky_wall", 8},
    {"twist", 38},
};

}  // namespace

TEST_CASE("hard steps converge within their bounds, with every filter to a minimum that is known", "[compare][problems]") {
  for (const StoredProblem& stored : problems) {
    INFO(stored.name);
    const CompareCase what = problem_case(std::string(TACK_TEST_DATA "/problems/") + stored.name + ".problem");
    const Reference reference = make_reference(what, what.step_size, 1e-9, 1e-7);
    REQUIRE(reference.found());
    if (!stored.branches) CHECK_FALSE(reference.other_branch);
    for (const char* filter : {"clamp", "absolute", "on_demand"}) {
      INFO(filter);
      Trial trial(what, {parse_string(std::string("{filter: ") + filter + "}", "(test)"), 1e-5, what.step_size});
      trial.record();
      const TrialResult& result = trial.run();
      REQUIRE_FALSE(trial.history().empty());
      if (!what.quasi_static) CHECK(trial.history().back().residual <= 1);
      CHECK(result.status == "converged");
      CHECK(result.intersections == 0);
      if (filter == std::string("clamp")) CHECK(result.iterations <= stored.most_iterations);
      const Branch branch = branch_of(what, reference, what.step_size, result.x);
      if (!stored.branches) CHECK(branch.kind != Branch::Kind::another);
      CHECK(largest_distance(trial.world(), result.x, branch.x) < 1e-3 * what.size);
    }
  }
}
