// tack batch from the command line.
#include <signal.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <chrono>
#include <random>
#include <thread>

#include "framework/output/checkpoints.hpp"
#include "tests/support/batch_files.hpp"
#include "tests/support/json.hpp"
#include "tests/support/program.hpp"

using namespace tack;
namespace fs = std::filesystem;
using namespace std::chrono_literals;

namespace {

// A row per line, without the measurements, which are the last columns.
std::vector<std::string> rows_of(const fs::path& folder) {
  std::istringstream in(file_text(folder / "results.csv"));
  std::vector<std::string> rows;
  size_t measured = 0;
  for (std::string line; std::getline(in, line);) {
    const size_t at = line.find("wall_seconds");
    if (rows.empty() && at != line.npos) measured = static_cast<size_t>(std::count(line.begin() + static_cast<long>(at), line.end(), ',')) + 1;
    for (size_t i = 0; i < measured; ++i) line.erase(line.rfind(','));
    rows.push_back(line);
  }
  return rows;
}

std::string status_of(const fs::path& folder, const std::string& name) {
  return fs::exists(folder / "state" / (name + ".json")) ? read_json(folder / "state" / (name + ".json"))["status"].get<std::string>() : "";
}

template <class Condition>
bool becomes_true(const Condition& condition) {
  const auto deadline = std::chrono::steady_clock::now() + TACK_PATIENCE * 30s;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > deadline) return false;
    std::this_thread::sleep_for(2ms);
  }
  return true;
}

// Returns the process of the run that writes into a folder.
pid_t process_in(const fs::path& run) {
  const std::string text = file_text(run / ".tack_run");
  const size_t at = text.find("process ");
  return at == text.npos ? 0 : std::stoi(text.substr(at + 8));
}

std::map<std::string, fs::file_time_type> done_states(const fs::path& folder) {
  std::map<std::string, fs::file_time_type> done;
  for (const auto& entry : fs::directory_iterator(folder / "state"))
    if (status_of(folder, entry.path().stem()) == "done") done[entry.path().stem()] = entry.last_write_time();
  return done;
}

}  // namespace

TEST_CASE("a batch that is killed and called again gives the table of one that was not", "[batch]") {
  const BatchFiles files(steps_batch);
  REQUIRE(run_tack(files.path, {"batch", "batch.yaml", "-o", "whole"}).exit_code == 0);
  std::random_device random;
  for (int attempt = 0;; ++attempt) {
    REQUIRE(attempt < 200);
    Program batch(files.path, {"batch", "batch.yaml", "-o", "parts"});
    const auto pause = std::chrono::milliseconds(200 + random() % 500);
    CAPTURE(attempt, pause.count());
    std::this_thread::sleep_for(TACK_PATIENCE * pause);
    batch.kill();
    batch.wait();
    if (!fs::exists(files.path / "parts" / "state")) continue;
    const auto done = done_states(files.path / "parts");
    if (attempt < 3 && done.size() < 12) continue;
    const ProgramResult last = run_tack(files.path, {"batch", "batch.yaml", "-o", "parts"});
    INFO(last.out << last.err);
    REQUIRE(last.exit_code == 0);
    for (const auto& [name, time] : done) CHECK(done_states(files.path / "parts").at(name) == time);  // not run again
    break;
  }
  CHECK(rows_of(files.path / "parts") == rows_of(files.path / "whole"));
  CHECK(rows_of(files.path / "whole").size() == 13);
  for (const auto& entry : fs::directory_iterator(files.path / "parts" / "cases"))
    CHECK(entry.path().filename().string().find("repeat=") != std::string::npos);
  const ProgramResult again = run_tack(files.path, {"batch", "batch.yaml", "-o", "parts"});
  CHECK(again.exit_code == 0);
  CHECK(contains(again.out, "12 of 12 cases are done already"));
  CHECK(contains(again.out, "12 done"));
}

TEST_CASE("a half-done case is resumed from its checkpoint", "[batch]") {
  const BatchFiles files("name: long\nbase: tiny.yaml\nset: [time.duration=1 s, output.checkpoint_interval=0.02 s, output.frames=false]\n");
  Program batch(files.path, {"batch", "batch.yaml", "-o", "b"});
  const fs::path checkpoints = files.path / "b" / "cases" / "case" / "checkpoints";
  REQUIRE(becomes_true([&] { return !newest_checkpoint_in(checkpoints).empty(); }));  // a complete one
  batch.kill();
  batch.wait();
  CHECK(status_of(files.path / "b", "case") == "running");
  const ProgramResult second = run_tack(files.path, {"batch", "batch.yaml", "-o", "b"});
  INFO(second.out << second.err);
  CHECK(second.exit_code == 0);
  CHECK(contains(file_text(files.path / "b" / "cases" / "case" / "log.txt"), "resumed at step"));
  // And from one that is damaged, at the start.
  fs::remove(files.path / "b" / "state" / "case.json");
  for (const auto& entry : fs::directory_iterator(checkpoints)) write_file(entry.path(), "damaged");
  CHECK(run_tack(files.path, {"batch", "batch.yaml", "-o", "b"}).exit_code == 0);
}

TEST_CASE("a case that is gone on with counts the seconds of all its pieces, and its warnings", "[batch]") {
  const BatchFiles files("name: long\nbase: tiny.yaml\nset: [time.duration=0.4 s, output.checkpoint_interval=0.02 s, output.frames=false]\n");
  const fs::path run = files.path / "b" / "cases" / "case", state = files.path / "b" / "state" / "case.json";
  REQUIRE(run_tack(files.path, {"batch", "batch.yaml", "-o", "b"}).exit_code == 0);
  const auto whole = rows_of(files.path / "b");
  CHECK(contains(whole[0], ",warnings"));
  // As if it had been cut short after an hour.
  for (const auto& entry : fs::directory_iterator(run / "checkpoints"))
    if (entry.path().filename() > "step_00000020") fs::remove(entry.path());
  const auto cut_short = [&](const char* status) {
    auto json = read_json(state);
    json["status"] = status;
    json["wall_seconds"] = 3600;
    json["cpu_seconds"] = 7200;
    json["memory_mb"] = 1e6;
    write_file(state, json.dump());
  };
  for (const char* status : {"interrupted", "running"}) {
    cut_short(status);
    REQUIRE(run_tack(files.path, {"batch", "batch.yaml", "-o", "b"}).exit_code == 0);
    const auto json = read_json(state);
    CHECK(json["status"] == "done");
    CHECK(json["wall_seconds"] > 3600.0);
    CHECK(json["wall_seconds"] < 3720.0);
    CHECK(json["cpu_seconds"] > 7200.0);
    CHECK(json["memory_mb"] == 1e6);
    CHECK(rows_of(files.path / "b") == whole);
  }
  // A fresh run has its own.
  cut_short("interrupted");
  for (const auto& entry : fs::directory_iterator(run / "checkpoints")) fs::remove(entry.path());
  REQUIRE(run_tack(files.path, {"batch", "batch.yaml", "-o", "b"}).exit_code == 0);
  CHECK(read_json(state)["wall_seconds"] < 3600.0);
}

TEST_CASE("a batch that is killed has noted the seconds of its running cases", "[batch]") {
  const BatchFiles files("name: long\nbase: tiny.yaml\nset: [time.duration=1000 s, output.frames=false]\n");
  const fs::path state = files.path / "b" / "state" / "case.json";
  Program batch(files.path, {"batch", "batch.yaml", "-o", "b"});
  REQUIRE(becomes_true([&] { return fs::exists(state) && read_json(state)["cpu_seconds"] > 0.0; }));
  batch.kill();
  batch.wait();
  CHECK(status_of(files.path / "b", "case") == "running");
  CHECK(read_json(state)["wall_seconds"] > 0.4);
}

TEST_CASE("Ctrl-C ends a batch with its cases, and they go on later", "[batch]") {
  const BatchFiles files("name: long\nbase: tiny.yaml\nset: [time.duration=10000 s, output.checkpoint_interval=0.02 s, output.frames=false]\n"
                    "vary: [{type: repeat, count: 3}]\njobs: 2\n");
  Program batch(files.path, {"batch", "batch.yaml", "-o", "b"});
  const auto steps = [&](const std::string& name) { return file_text(files.path / "b" / "cases" / name / "steps.csv").size(); };
  REQUIRE(becomes_true([&] { return steps("repeat=1") > 2000 && steps("repeat=2") > 2000; }));
  batch.interrupt();
  const ProgramResult result = batch.wait();
  CHECK(result.exit_code == 130);
  CHECK(contains(result.out, "2 interrupted"));
  CHECK(contains(result.out, "1 waiting"));
  CHECK(status_of(files.path / "b", "repeat=1") == "interrupted");
  CHECK(fs::exists(files.path / "b" / "cases" / "repeat=1" / "summary.json"));
  CHECK(rows_of(files.path / "b").size() == 4);
}

TEST_CASE("a crash, a time-out and a failed expectation are rows, and touch no other case", "[batch]") {
  const BatchFiles files(R"(name: mixed
base: tiny.yaml
set: [output.frames=false]
time_limit: 3 s
jobs: 2
vary:
  - type: cases
    cases:
      - {name: crashes, set: {time.duration: 1000 s}}
      - {name: takes_too_long, set: {time.duration: 1000 s}}
      - {name: wrong, set: {expect.0.at_least: 5 m}}
      - {name: cannot, set: {solver.max_iterations: 1, time.max_cutbacks: 0}}
      - {name: right}
)");
  Program batch(files.path, {"batch", "batch.yaml", "-o", "b"});
  const fs::path run = files.path / "b" / "cases" / "variant=crashes";
  REQUIRE(becomes_true([&] { return file_text(run / "steps.csv").size() > 2000; }));
  REQUIRE(process_in(run) > 0);
  ::kill(process_in(run), SIGSEGV);
  const ProgramResult result = batch.wait();
  INFO(result.out << result.err);
  CHECK(result.exit_code == 3);
  const auto rows = rows_of(files.path / "b");
  REQUIRE(rows.size() == 6);
  CHECK(contains(rows[1], ",crashes,crashed,ended by signal 11"));
  CHECK(contains(rows[2], ",takes_too_long,timed out,not done within its time limit of 3 s"));
  CHECK(contains(rows[3], ",wrong,expectation failed,,0,"));
  CHECK(contains(rows[4], ",cannot,simulation failed,"));
  CHECK(contains(rows[5], ",right,done,,1,"));
  CHECK(contains(result.out, "1 crashed"));
  // Only failed cases run again, and only on request.
  CHECK(contains(run_tack(files.path, {"batch", "batch.yaml", "-o", "b"}).out, "5 of 5 cases are done already"));
  const auto right = fs::last_write_time(files.path / "b" / "state" / "variant=right.json");
  const ProgramResult again = run_tack(files.path, {"batch", "batch.yaml", "-o", "b", "--failed", "--set", "time_limit=1 s"});
  CHECK(contains(again.out, "1 of 5 cases are done already"));
  CHECK(contains(again.out, "2 timed out"));
  CHECK(fs::last_write_time(files.path / "b" / "state" / "variant=right.json") == right);
}

TEST_CASE("a case whose files cannot be written fails alone, and keeps no earlier result",
          "[batch]") {
  const BatchFiles files(
      "name: some\nbase: tiny.yaml\nset: [output.frames=false]\njobs: 1\n"
      "vary: [{type: cases, cases: [{name: bad}, {name: good}]}]\n");
  REQUIRE(run_tack(files.path, {"batch", "batch.yaml", "-o", "b"}).exit_code == 0);
  const fs::path b = files.path / "b", output = b / "output" / "variant=bad.txt";
  for (const char* name : {"bad", "good"})
    fs::remove_all(b / "cases" / (std::string("variant=") + name));  // so that both run again
  fs::remove(output);
  fs::create_directories(output / "in_the_way");
  const ProgramResult result = run_tack(files.path, {"batch", "batch.yaml", "-o", "b"});
  INFO(result.out << result.err);
  CHECK(result.exit_code != 0);
  const auto rows = rows_of(b);
  REQUIRE(rows.size() == 3);
  CHECK(contains(rows[1], ",bad,refused,"));
  CHECK(contains(rows[1], "cannot be written: "));
  CHECK(contains(rows[1], "variant=bad.txt"));
  CHECK(contains(rows[2], ",good,done,"));
}

TEST_CASE("cases that are named run alone, and the others stay as they are", "[batch]") {
  const BatchFiles files("name: some\nbase: tiny.yaml\nset: [output.frames=false]\n"
                    "vary: [{type: cases, cases: [{name: wrong, set: {expect: [{probe: height, statistic: final, at_least: 1 m}]}}, {name: right}, {name: rest}]}]\n");
  const ProgramResult unknown = run_tack(files.path, {"batch", "batch.yaml", "-o", "b", "--only", "left"});
  CHECK(unknown.exit_code == 2);
  CHECK(contains(unknown.err, "--only left: no case has such a name; the first is 'variant=wrong', --dry-run lists them"));
  const ProgramResult right = run_tack(files.path, {"batch", "batch.yaml", "-o", "b", "--only", "variant=ri*"});
  INFO(right.out << right.err);
  CHECK(right.exit_code == 0);
  CHECK(contains(right.out, "[1/1] variant=right"));
  CHECK(done_states(files.path / "b").size() == 1);
  const auto written = done_states(files.path / "b");
  CHECK(run_tack(files.path, {"batch", "batch.yaml", "-o", "b", "--only", "variant=right", "--only", "variant=wrong"}).exit_code == 1);
  CHECK(run_tack(files.path, {"batch", "batch.yaml", "-o", "b", "--only", "variant=right"}).exit_code == 0);
  CHECK(status_of(files.path / "b", "variant=rest").empty());
  CHECK(done_states(files.path / "b") == written);
  CHECK(run_tack(files.path, {"batch", "batch.yaml", "-o", "b"}).exit_code == 1);
  CHECK(done_states(files.path / "b").size() == 2);
}

TEST_CASE("a case that wants more memory than it may have fails alone", "[batch]") {
#ifndef __SANITIZE_ADDRESS__
  const BatchFiles files("name: memory\nbase: tiny.yaml\nset: [output.frames=false]\nmemory: 0.6\njobs: 1\n"
                    "vary: [{type: grid, keys: {objects.block.shape.cells: [[1, 1, 1], [45, 45, 45]]}}]\n");
  const ProgramResult result = run_tack(files.path, {"batch", "batch.yaml", "-o", "b"});
  INFO(result.out << result.err);
  CHECK(result.exit_code == 3);
  CHECK(contains(result.out, "1 done, 1 simulation failed"));
  CHECK(contains(result.out, "not enough memory"));
#endif
}

TEST_CASE("a case that may have too little memory ends at once and says so", "[batch]") {
#ifndef __SANITIZE_ADDRESS__
  const BatchFiles files("name: little\nbase: tiny.yaml\nset: [output.frames=false]\nmemory: 0.001\n");
  const auto begun = std::chrono::steady_clock::now();
  const ProgramResult none = run_tack(files.path, {"batch", "batch.yaml", "-o", "b"});
  CHECK(std::chrono::steady_clock::now() - begun < TACK_PATIENCE * 10s);
  CHECK(none.exit_code == 3);
  CHECK(contains(none.out, "memory: 0.001 GB is less than the program takes"));
  CHECK(run_tack(files.path, {"batch", "batch.yaml", "-o", "b", "--failed", "--set", "memory=0.1"}).exit_code == 0);
#endif
}

TEST_CASE("another batch in the same folder leaves the first one's table", "[batch]") {
  const BatchFiles files("name: first\nbase: tiny.yaml\nset: [output.frames=false]\nvary: [{type: grid, keys: {time.step: {values: [5 ms], as: step}}}]\n");
  REQUIRE(run_tack(files.path, {"batch", "batch.yaml", "-o", "b"}).exit_code == 0);
  const std::string table = file_text(files.path / "b" / "results.csv");
  // More values: the same batch.
  write_file(files.path / "batch.yaml", "name: first\nbase: tiny.yaml\nset: [output.frames=false]\n"
                                        "vary: [{type: grid, keys: {time.step: {values: [5 ms, 4 ms], as: step}}}]\n");
  CHECK(contains(run_tack(files.path, {"batch", "batch.yaml", "-o", "b"}).out, "1 of 2 cases are done already"));
  const std::string longer = file_text(files.path / "b" / "results.csv");
  write_file(files.path / "other.yaml", "name: second\nbase: tiny.yaml\nset: [output.frames=false]\nvary: [{type: repeat, count: 1}]\n");
  const ProgramResult other = run_tack(files.path, {"batch", "other.yaml", "-o", "b"});
  INFO(other.out << other.err);
  CHECK(other.exit_code == 0);
  CHECK(contains(other.out, "another batch that was there is moved to"));
  CHECK(file_text(files.path / "b.1" / "results.csv") == longer);
  CHECK(contains(longer, table.substr(table.find('\n') + 1, 10)));
  CHECK(rows_of(files.path / "b").size() == 2);
}

TEST_CASE("a dry run shows the plan and writes nothing", "[batch]") {
  const BatchFiles files(steps_batch);
  const ProgramResult plan = run_tack(files.path, {"batch", "batch.yaml", "--dry-run"});
  CHECK(plan.exit_code == 0);
  CHECK(contains(plan.out, "12 cases, 12 to run"));
  CHECK(contains(plan.out, "young=2MPa,friction=mu=0.4,repeat=1  waiting"));
  CHECK(contains(plan.out, "in all; nothing was run yet"));
  CHECK_FALSE(fs::exists(files.path / "results" / "steps"));
}

TEST_CASE("a batch with a bad case starts none, and folders of others are left alone", "[batch]") {
  const BatchFiles files("name: bad\nbase: tiny.yaml\nvary: [{type: grid, keys: {objects.block.place.translate: [[0, 0.2, 0], [0, 0.05, 0]]}}]\n");
  const ProgramResult bad = run_tack(files.path, {"batch", "batch.yaml", "-o", "b"});
  CHECK(bad.exit_code == 2);
  CHECK(contains(bad.err, "case 'translate=0,0.05,0'"));
  CHECK_FALSE(fs::exists(files.path / "b"));
  fs::create_directories(files.path / "mine");
  write_file(files.path / "mine" / "thesis.txt", "text");
  const ProgramResult foreign = run_tack(files.path, {"batch", "batch.yaml", "-o", "mine", "--only", "translate=0,0.2,0"});
  CHECK(foreign.exit_code == 2);
  CHECK(contains(foreign.err, "contains other files"));
}

TEST_CASE("one batch at a time writes into a folder", "[batch]") {
  const BatchFiles files("name: long\nbase: tiny.yaml\nset: [time.duration=1000 s, output.frames=false]\n");
  Program first(files.path, {"batch", "batch.yaml", "-o", "b"});
  REQUIRE(becomes_true([&] { return status_of(files.path / "b", "case") == "running"; }));
  const ProgramResult second = run_tack(files.path, {"batch", "batch.yaml", "-o", "b"});
  CHECK(second.exit_code == 2);
  CHECK(contains(second.err, "another run"));
}
