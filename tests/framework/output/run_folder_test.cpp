#include "framework/output/run_folder.hpp"

#include <catch2/catch.hpp>

#include "geometry/errors.hpp"
#include "tests/support/silence.hpp"

using namespace tack;
namespace fs = std::filesystem;

namespace {

void touch(const fs::path& path, const std::string& text = "x") { std::ofstream(path) << text; }

std::string text_of(const fs::path& path) {
  std::ifstream in(path);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

TEST_CASE("a run gets its folder; inner folders are made on first use") {
  const TemporaryFolder folder;
  const RunFolder run = RunFolder::create(folder.path() / "results" / "tape");
  CHECK(run.root() == folder.path() / "results" / "tape");
  CHECK(fs::is_directory(run.root()));
  CHECK_FALSE(fs::exists(run.frames()));
  CHECK_FALSE(fs::exists(run.checkpoints()));
  CHECK_FALSE(run.moved_aside());
  CHECK(run.steps() == run.root() / "steps.csv");
  CHECK(run.root() / RunFolder::frame(12) == run.frames() / "frame_000012.vtu");
}

TEST_CASE("a run folder moves an earlier run aside") {
  const TemporaryFolder folder;
  const fs::path root = folder.path() / "tape";
  for (int i = 0; i < 3; ++i) {
    const RunFolder run = RunFolder::create(root / "");  // with a trailing slash
    CHECK(run.moved_aside().has_value() == (i > 0));
    touch(run.log(), std::to_string(i));
  }
  CHECK(text_of(root / "log.txt") == "2");
  CHECK(text_of(folder.path() / "tape.1" / "log.txt") == "0");
  CHECK(text_of(folder.path() / "tape.2" / "log.txt") == "1");
  CHECK(RunFolder::open(folder.path() / "tape.1").log() == folder.path() / "tape.1" / "log.txt");
}

TEST_CASE("a run behind a link is moved aside in its own folder") {
  const TemporaryFolder folder;
  const fs::path disk = folder.path() / "disk" / "tape";
  touch(RunFolder::create(disk).log(), "old");
  fs::create_directory_symlink(disk, folder.path() / "link");
  const RunFolder run = RunFolder::create(folder.path() / "link");
  CHECK(text_of(folder.path() / "disk" / "tape.1" / "log.txt") == "old");
  CHECK(fs::is_directory(disk));
  CHECK(run.root() == fs::canonical(disk));
  CHECK(fs::is_symlink(folder.path() / "link"));
}

TEST_CASE("an empty folder is used, anything else is refused") {
  const TemporaryFolder folder;
  fs::create_directory(folder.path() / "empty");
  CHECK_FALSE(RunFolder::create(folder.path() / "empty").moved_aside());

  const fs::path thesis = folder.path() / "thesis";
  fs::create_directories(thesis / "frames");
  touch(thesis / "scene.yaml");
  CHECK_THROWS_WITH(RunFolder::create(thesis),
                    thesis.string() +
                        ": contains other files than those of a run of tack; choose another "
                        "results folder with -o");
  CHECK(fs::exists(thesis / "scene.yaml"));
  CHECK_THROWS_AS(RunFolder::open(thesis), InputError);

  touch(folder.path() / "file");
  CHECK_THROWS_WITH(RunFolder::create(folder.path() / "file"), Catch::Contains("is a file"));
  CHECK_THROWS_WITH(RunFolder::create(folder.path() / "file" / "tape"),
                    Catch::Contains("choose another results folder"));
  CHECK_THROWS_AS(RunFolder::create(""), InputError);
}

TEST_CASE("the working directory is never moved") {
  const fs::path before = fs::current_path();
  const TemporaryFolder folder;
  const RunFolder run = RunFolder::create(folder.path() / "tape");
  fs::create_directory(run.frames());
  fs::current_path(run.frames());
  CHECK_THROWS_WITH(RunFolder::create("."), Catch::Contains("working directory"));
  CHECK_THROWS_WITH(RunFolder::create(run.root()), Catch::Contains("working directory"));
  CHECK_NOTHROW(RunFolder::create("../../tape2"));
  fs::current_path(before);
  CHECK(fs::exists(run.root()));
}

TEST_CASE("the default folder is named after the scene") {
  CHECK(RunFolder::default_root("peel_90") == fs::path("results/peel_90"));
  CHECK(RunFolder::default_root("tape peeled: off/desk") ==
        fs::path("results/tape_peeled__off_desk"));
  CHECK(RunFolder::default_root("..") == fs::path("results/_."));
  CHECK(RunFolder::default_root("") == fs::path("results/scene"));
}

TEST_CASE("two runs do not write into one folder") {
  const TemporaryFolder folder;
  const fs::path root = folder.path() / "tape";
  {
    const RunFolder first = RunFolder::create(root);
    CHECK_THROWS_WITH(RunFolder::create(root), Catch::Contains(root.string() + ": another run (process ") &&
                                                   Catch::Contains("choose another results folder with -o"));
    CHECK_THROWS_WITH(RunFolder::open(root), Catch::Contains("another run"));
    CHECK(fs::exists(first.root()));
    CHECK_FALSE(fs::exists(root.string() + ".1"));
    const RunFolder copy = first;  // one lock for both
  }
  CHECK_NOTHROW(RunFolder::open(root));
  CHECK(RunFolder::create(root).moved_aside());
}
