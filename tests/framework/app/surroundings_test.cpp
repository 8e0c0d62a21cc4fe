// The surroundings that a shell or a queue gives the program: limits, closed streams, readers that go away.
#include <catch2/catch.hpp>

#include "tests/support/json.hpp"
#include "tests/support/program.hpp"
#include "tests/support/tiny_scene.hpp"

using namespace tack;
namespace fs = std::filesystem;

namespace {

// In a folder with the tiny scene, $TACK the program.
struct Shell {
  Shell() { write_file(folder.path() / "scene.yaml", tiny_scene); }
  ProgramResult run(const std::string& command) const {
    return run_tack(folder.path(), {"-c", "TACK=" + std::string(TACK_PROGRAM) + "; " + command}, "/bin/bash");
  }
  fs::path results() const { return folder.path() / "results/tiny"; }
  std::string status() const { return read_json(results() / "summary.json")["status"]; }
  TemporaryFolder folder;
};

}  // namespace

TEST_CASE("an address space that is too small is refused at once") {
#ifndef __SANITIZE_ADDRESS__
  const Shell shell;
  for (const char* command : {"list", "run scene.yaml --threads 1", "run scene.yaml --threads 8"}) {
    INFO(command);
    const bool own = std::string(command).ends_with("8");  // not enough for so many threads alone
    const ProgramResult result = shell.run(std::string("ulimit -v ") + (own ? "700000" : "200000") + "; $TACK " + command);
    CHECK(result.exit_code == 2);
    CHECK((contains(result.err, "the address space is limited to") || contains(result.err, "error while loading")));
    CHECK((contains(result.err, "raise that limit") || contains(result.err, "error while loading")));
  }
#endif
}

TEST_CASE("a closed output pipe ends a run as Ctrl-C does") {
  const Shell shell;
  const ProgramResult result = shell.run("$TACK run scene.yaml -v --set time.duration=1000 | head -n 5; exit ${PIPESTATUS[0]}");
  CHECK(result.exit_code == 130);
  CHECK(shell.status() == "interrupted");
  CHECK(shell.run("$TACK run scene.yaml --set time.duration=1000 --resume --steps 1").exit_code == 0);
}

TEST_CASE("a limit of file sizes ends a run with a word") {
  const Shell shell;
  const ProgramResult result = shell.run("ulimit -f 8; $TACK run scene.yaml --set time.duration=1000 output.frames=false");
  INFO(result.out << result.err);
  CHECK(result.exit_code > 0);
  CHECK(result.exit_code < 128 + 3);
  CHECK((contains(result.err, "cannot be written (File too large)") || shell.status() == "interrupted"));
}

TEST_CASE("without a standard output, messages go into no file") {
  const Shell shell;
  const ProgramResult result = shell.run("$TACK run scene.yaml -v >&- 2>&-");
  CHECK(result.exit_code == 0);
  for (const auto& entry : fs::recursive_directory_iterator(shell.results())) {
    if (entry.path().filename() == "log.txt" || !entry.is_regular_file()) continue;
    INFO(entry.path());
    CHECK_FALSE(contains(file_text(entry.path()), "step 4  t"));
  }
  CHECK(contains(file_text(shell.results() / "log.txt"), "step 4  t"));
}

TEST_CASE("a time step whose square is no number is refused") {
  const Shell shell;
  for (const char* step : {"1e-320", "1e-200 s", "1e-101"}) {
    const ProgramResult result = shell.run(std::string("$TACK check scene.yaml --set 'time.step=") + step + "'");
    INFO(result.err);
    CHECK(result.exit_code == 2);
    CHECK(contains(result.err, "too short to compute with"));
  }
}
