#include "framework/output/frame_writer.hpp"

#include <sys/stat.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <limits>
#include <thread>

#include "framework/run/recorded_run.hpp"
#include "geometry/errors.hpp"
#include "tests/support/program.hpp"
#include "tests/support/tiny_scene.hpp"

using namespace tack;
namespace fs = std::filesystem;

namespace {

FrameGeometry tet() { return {4, {{0, 1, 2, 3}}, {}, {}, {}, {0}}; }
VecX corners(double scale) { return scale * VecX::LinSpaced(12, 0, 1); }

struct Results {
  TemporaryFolder outside;
  RunFolder folder = RunFolder::create(outside.path() / "results");
  FrameWriter writer{folder, PvdFile(folder.pvd()), tet()};

  fs::path frame(int number) const { return folder.root() / RunFolder::frame(number); }
  // The file that replace_file() writes before it is renamed.
  fs::path draft(int number) const { return frame(number).string() + ".part"; }
  int listed() const { return PvdFile::continued(folder.pvd(), std::numeric_limits<double>::infinity()).frames(); }
  void write(int number) { writer.write(0.1 * number, corners(number), {{"mass", 1, VecX::Constant(4, number), "kg"}}, {}); }
};

void fill_disk_at(const fs::path& draft) {
  fs::create_directories(draft.parent_path());
  fs::create_symlink("/dev/full", draft);
}

}  // namespace

TEST_CASE("frames have the bytes of write_vtu() and are listed in order", "[run]") {
  Results results;
  for (int i = 0; i < 5; ++i) results.write(i);
  results.writer.flush();
  const auto list = PvdFile::continued(results.folder.pvd(), 1).list();
  REQUIRE(list.size() == 5);
  for (int i = 0; i < 5; ++i) {
    CHECK(list[i].time == 0.1 * i);
    CHECK(list[i].file == RunFolder::frame(i).string());
    const fs::path alone = results.outside.path() / "alone.vtu";
    write_vtu(alone, tet(), corners(i), 0.1 * i, {{"mass", 1, VecX::Constant(4, i), "kg"}});
    CHECK(file_text(results.frame(i)) == file_text(alone));
    CHECK_FALSE(fs::exists(results.draft(i)));
  }
}

TEST_CASE("all frames are written when a writer has ended", "[run]") {
  const TemporaryFolder outside;
  const RunFolder folder = RunFolder::create(outside.path() / "results");
  {
    FrameWriter writer(folder, PvdFile(folder.pvd()), tet());
    writer.write(0, corners(1), {}, {});
  }
  CHECK(PvdFile::continued(folder.pvd(), 1).frames() == 1);
  CHECK_FALSE(file_text(folder.root() / RunFolder::frame(0)).empty());
}

// The disk is a pipe that nobody reads.
TEST_CASE("a slow disk does not stop a run before its next frame", "[run]") {
  Results results;
  results.write(0);
  results.writer.flush();
  REQUIRE(::mkfifo(results.draft(1).c_str(), 0600) == 0);
  results.write(1);  // returns
  CHECK(results.listed() == 1);
  CHECK_FALSE(fs::exists(results.frame(1)));
  std::thread disk([&] { file_text(results.draft(1)); });
  results.write(2);
  CHECK(results.listed() >= 2);
  results.writer.flush();
  disk.join();
  CHECK(results.listed() == 3);
}

TEST_CASE("a full disk is reported by the next frame or the end, and the frame is not listed", "[run]") {
  Results results;
  results.write(0);
  fill_disk_at(results.draft(1));
  results.write(1);
  const bool at_the_end = GENERATE(true, false);
  const auto next = [&] { at_the_end ? results.writer.flush() : results.write(2); };
  CHECK_THROWS_WITH(next(), Catch::Contains("frame_000001.vtu: cannot be written (No space left on device)"));
  CHECK(results.listed() == 1);
  CHECK_FALSE(fs::exists(results.frame(1)));
  CHECK_FALSE(fs::exists(results.frame(2)));
}

// Frame 3 is that of step 3, after which a checkpoint is due; frame 5 is the last.
TEST_CASE("a run with a full disk ends with the error and without a checkpoint that names the frame", "[run]") {
  const int full = GENERATE(3, 5);
  const TemporaryFolder outside;
  RunSettings settings;
  settings.output = (outside.path() / "results").string();
  std::ostringstream printed;
  RecordedRun run(parse_experiment(tiny_scene + "output: {checkpoint_interval: 0.03 s}\n", "tiny.yaml"), settings, {}, printed, {});
  const fs::path root = outside.path() / "results";
  fill_disk_at(root / (RunFolder::frame(full).string() + ".part"));
  CHECK_THROWS_AS(run.execute(), InputError);
  CHECK(PvdFile::continued(root / "run.pvd", 1).frames() == full);
  CHECK(fs::exists(root / "checkpoints/step_00000003.checkpoint") == (full > 3));
}
