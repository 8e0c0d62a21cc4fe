// Job arrays of a batch: each case is run by one task, whatever MaxArraySize is. The script itself is
// run by a real Slurm in tests/batch/slurm.sh.
#include "framework/batch/slurm.hpp"

#include <catch2/catch.hpp>
#include <cstdlib>
#include <numeric>
#include <sstream>
#include <thread>

#include "framework/batch/slurm_tasks.hpp"
#include "geometry/errors.hpp"
#include "geometry/interrupt.hpp"
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

// Stands for sbatch while it lives: a script in a folder that PATH begins with.
class Sbatch {
 public:
  Sbatch(const std::filesystem::path& folder, const std::string& script) : path_(std::getenv("PATH")) {
    write_file(folder / "sbatch", "#!/bin/sh\n" + script);
    std::filesystem::permissions(folder / "sbatch", std::filesystem::perms::owner_all);
    setenv("PATH", (folder.string() + ":" + path_).c_str(), 1);
  }
  ~Sbatch() { setenv("PATH", path_.c_str(), 1); }

 private:
  std::string path_;
};

TEST_CASE("the number of a job is found behind messages; a refusal names the jobs before it", "[batch]") {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder.path() / "b" / "output");
  const BatchFolder batch{folder.path() / "b", nullptr};
  BatchDescription description;
  description.plan.cases.resize(3);
  SlurmConfig slurm;
  slurm.max_array_size = 2;
  const auto submitted = [&](const std::string& script) {
    const Sbatch sbatch(folder.path(), script);
    return submit("tack", batch, slurm, description, {0, 1, 2}, false);
  };
  SlurmJobs jobs = submitted("echo 'sbatch: info: 3 hours are left' >&2\nsleep 0.1\necho '12;cluster'\n");
  CHECK(jobs.ids == std::vector<std::string>{"12", "12"});
  CHECK_THROWS_WITH(submitted("echo 'sbatch: error: no such partition' >&2\nexit 1\n"), Catch::Equals("Slurm does not take the batch: sbatch: error: no such partition"));
  CHECK_THROWS_WITH(submitted("test -e " + (folder.path() / "once").string() + " && { echo 'sbatch: error: too many jobs' >&2; exit 1; }\ntouch " + (folder.path() / "once").string() + "\necho 7\n"),
                    Catch::Contains("Slurm does not take all of the batch: sbatch: error: too many jobs\njob 7 goes on (`scancel 7` ends it)"));
}

TEST_CASE("an interrupt ends the submission, also while sbatch does not answer", "[batch]") {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder.path() / "b" / "output");
  const BatchFolder batch{folder.path() / "b", nullptr};
  BatchDescription description;
  description.plan.cases.resize(3);
  SlurmConfig slurm;
  slurm.max_array_size = 2;
  const auto interrupted = [&](const std::string& script) {
    const Sbatch sbatch(folder.path(), script);
    SlurmJobs jobs;
    {
      const std::jthread later([&](const std::stop_token& done) {
        while (!done.stop_requested() && !std::filesystem::exists(folder.path() / "asked")) std::this_thread::sleep_for(std::chrono::milliseconds(5));
        interrupt_requested = !done.stop_requested();
      });
      jobs = submit("tack", batch, slurm, description, {0, 1, 2}, false);
    }
    interrupt_requested = false;
    std::filesystem::remove(folder.path() / "asked");
    return jobs.running_text();
  };
  const std::string asked = "touch " + (folder.path() / "asked").string() + "\n", once = (folder.path() / "once").string();
  CHECK(interrupted(asked + "sleep 600\n") == "sbatch had not answered, `squeue --me` lists what Slurm has taken");
  CHECK(interrupted("test -e " + once + " && { " + "touch " + (folder.path() / "asked").string() + "; sleep 600; }\ntouch " + once + "\necho 7\n") ==
        "job 7 goes on (`scancel 7` ends it); sbatch had not answered, `squeue --me` lists what Slurm has taken");
  CHECK(SlurmJobs{}.running_text() == "no job was submitted");
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
