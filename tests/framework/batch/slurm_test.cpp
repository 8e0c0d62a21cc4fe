// Job arrays of a batch: each case is run by one task, whatever MaxArraySize is. The script itself is
// run by a real Slurm in tests/batch/slurm.sh.
#include "framework/batch/slurm.hpp"

#include <catch2/catch.hpp>
#include <numeric>
#include <sstream>

namespace tack {
namespace {

// Returns the numbers of "0-3,7".
std::vector<size_t> numbers(const std::string& ranges) {
  std::vector<size_t> all;
  std::istringstream in(ranges);
  for (std::string part; std::getline(in, part, ',');) {
    const size_t first = std::stoul(part), dash = part.find('-');
    const size_t last = dash == part.npos ? first : std::stoul(part.substr(dash + 1));
    for (size_t i = first; i <= last; ++i) all.push_back(i);
  }
  return all;
}

TEST_CASE("job arrays run each case once, with indices below the cluster's limit", "[batch]") {
  std::vector<size_t> all(2500), some{0, 3, 4, 5, 999, 1000, 1001, 2400};
  std::iota(all.begin(), all.end(), size_t{0});
  for (const std::vector<size_t>& cases : {all, some})
    for (const size_t size : {1u, 7u, 1000u, 1001u, 2500u, 100000u}) {
      std::vector<size_t> run;
      for (const JobArray& array : job_arrays(cases, size))
        for (const size_t task : numbers(array.tasks)) {
          REQUIRE(task < size);
          run.push_back(array.offset + task);
        }
      REQUIRE(run == cases);
    }
  CHECK(job_arrays({0, 1, 2, 5}, 100).front().tasks == "0-2,5");
  CHECK(job_arrays(all, 1001).size() == 3);
  CHECK(job_arrays({}, 10).empty());
}

}  // namespace
}  // namespace tack
