// Cases of a batch depend on the libraries of the program.
#include <catch2/catch.hpp>

#include "tests/support/program.hpp"
#include "tests/support/tiny_scene.hpp"

using namespace tack;
namespace fs = std::filesystem;

// Meshes are made by a library that is built by itself.
TEST_CASE("cases are run again once a library of the program is another, and no folder is made for names of none") {
  const TemporaryFolder folder;
  const fs::path bin = folder.path() / "bin", program = bin / "tack", library = bin / "libtack_meshing.so";
  fs::create_directory(bin);
  for (const char* name : {"tack", "tack_studies"}) fs::copy_file(fs::path(TACK_PROGRAM).parent_path() / name, bin / name);
  write_file(library, "one");
  write_file(folder.path() / "scene.yaml", tiny_scene);
  write_file(folder.path() / "batch.yaml", "name: b\nbase: scene.yaml\nvary: [{type: grid, keys: {time.step: [10 ms]}}]\n");
  const auto runs = [&] {
    const ProgramResult result = run_tack(folder.path(), {"batch", "batch.yaml"}, program.string());
    INFO(result.out << result.err);
    REQUIRE(result.exit_code == 0);
    return !contains(result.out, "are done already");
  };
  CHECK(run_tack(folder.path(), {"batch", "batch.yaml", "--only", "none*"}, program.string()).exit_code == 2);
  CHECK_FALSE(fs::exists(folder.path() / "results"));
  CHECK(runs());
  CHECK_FALSE(runs());
  write_file(library, "two");
  CHECK(runs());
  CHECK_FALSE(runs());
  const fs::path run = folder.path() / "results/b/cases";
  for (const auto& one : fs::directory_iterator(run)) CHECK_FALSE(fs::exists(one.path() / "checkpoints"));
}
