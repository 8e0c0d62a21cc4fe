// Job arrays of a batch: each case is run by one task, whatever MaxArraySize is. The script itself is
// run by a real Slurm in tests/batch/slurm.sh.
#include "framework/batch/slurm.hpp"

#include <catch2/catch.hpp>
#include <numeric>
#include <sstream>

#include "framework/batch/slurm_tasks.hpp"
#include "geometry/errors.hpp"
#include "tests/support/program.hpp"

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

TEST_CASE("a task reads the line of its case", "[batch]") {
  const TemporaryFolder folder;
  const BatchFolder batch{folder.path(), nullptr};
  std::vector<BatchCase> cases(120);
  for (size_t i = 0; i < cases.size(); ++i) cases[i].name = std::string(i % 7, 'x') + std::to_string(i), cases[i].digest = "12-\xc3\xa4 " + std::string(i % 3, '"');
  const BatchLimits limits{3, 8, 1.5, std::nullopt};
  CHECK_THROWS_WITH(read_task(batch, 0), Catch::Contains("tasks.jsonl: cannot be read; submit the cases again with --slurm"));
  write_tasks(batch, cases, limits);
  for (size_t i = 0; i < cases.size(); ++i) {
    const SlurmTask task = read_task(batch, static_cast<int>(i));
    CHECK(task.one.name == cases[i].name);
    CHECK(task.one.digest == cases[i].digest);
    CHECK(task.limits.threads == 3);
    CHECK(task.limits.memory == 1.5);
    CHECK_FALSE(task.limits.time_limit);
  }
  for (const int none : {-1, 120}) CHECK_THROWS_WITH(read_task(batch, none), Catch::Contains("the batch has 120 cases, counted from 0"));
  std::filesystem::resize_file(batch.tasks(), std::filesystem::file_size(batch.tasks()) - 40);
  CHECK_THROWS_AS(read_task(batch, 119), InputError);
  CHECK(read_task(batch, 118).one.name == cases[118].name);
}

}  // namespace
}  // namespace tack
