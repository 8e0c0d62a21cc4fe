#include "framework/output/pvd.hpp"

#include <catch2/catch.hpp>

#include "geometry/errors.hpp"
#include "tests/support/silence.hpp"

using namespace tack;

namespace {

std::string text_of(const std::filesystem::path& path) {
  std::ifstream in(path);
  return {std::istreambuf_iterator<char>(in), {}};
}

const std::string two_frames = R"(<?xml version="1.0"?>
<VTKFile type="Collection" version="0.1" byte_order="LittleEndian">
  <Collection>
    <DataSet timestep="0" part="0" file="frames/frame_000000.vtu"/>
    <DataSet timestep="0.02" part="0" file="frames/a &amp; &quot;b&quot;.vtu"/>
  </Collection>
</VTKFile>
)";

}  // namespace

TEST_CASE("run.pvd lists the frames with their times") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "run.pvd";
  PvdFile list(path);
  CHECK_FALSE(std::filesystem::exists(path));
  list.add(0, "frames/frame_000000.vtu");
  list.add(0.02, "frames/a & \"b\".vtu");
  CHECK(text_of(path) == two_frames);
  CHECK(list.frames() == 2);
}

TEST_CASE("run.pvd is continued from a given time") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "run.pvd";
  CHECK(PvdFile::continued(path, 1).frames() == 0);
  std::ofstream(path) << two_frames;
  CHECK(PvdFile::continued(path, 0.01).frames() == 1);
  PvdFile list = PvdFile::continued(path, 0.02);
  REQUIRE(list.frames() == 2);
  list.add(0.1 + 0.2, "frames/c.vtu");
  const std::string text = text_of(path);
  CHECK(text.find("a &amp; &quot;b&quot;.vtu\"/>\n    <DataSet timestep=\"0.30000000000000004\" "
                  "part=\"0\" file=\"frames/c.vtu\"/>\n  </Collection>") != std::string::npos);
}

TEST_CASE("a run.pvd with other content is refused") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "run.pvd";
  std::ofstream(path) << "<DataSet timestep=\"soon\" file=\"a.vtu\"/>\n";
  CHECK_THROWS_WITH(PvdFile::continued(path, 1),
                    Catch::StartsWith(path.string() + ": '<DataSet timestep=\"soon\""));
}
