// tack mesh as its users call it.
#include <catch2/catch.hpp>
#include <regex>

#include "geometry/io/mesh_io.hpp"
#include "geometry/io/write_mesh.hpp"
#include "geometry/mesh/quality.hpp"
#include "geometry/meshing/defects.hpp"
#include "tests/support/broken_meshes.hpp"
#include "tests/support/program.hpp"

using namespace tack;
using Catch::Matchers::Contains;

TEST_CASE("tack mesh info tells defects by number") {
  const TemporaryFolder folder;
  write_mesh(folder.path() / "broken.off", with_flipped());
  const ProgramResult r = run_tack(folder.path(), {"mesh", "info", "broken.off"});
  CHECK(r.exit_code == 0);
  CHECK_THAT(r.out, Contains("manifold yes, closed yes, crosses itself no; parts 1, holes 0") && Contains("pairs of neighbours") &&
                        Contains("degrees"));
}

TEST_CASE("tack mesh goes from a broken file to tets of good angles") {
  const TemporaryFolder folder;
  write_mesh(folder.path() / "broken.ply", with_two_holes());
  const auto run = [&](const Arguments& words) {
    Arguments all = {"mesh"};
    all.insert(all.end(), words.begin(), words.end());
    const ProgramResult r = run_tack(folder.path(), all);
    INFO(r.err);
    CHECK(r.exit_code == 0);
    return r.out;
  };
  CHECK_THAT(run({"repair", "broken.ply", "-o", "whole.stl"}), Contains("filled 2 holes"));
  CHECK_THAT(run({"remesh", "whole.stl", "-o", "even.obj", "edge_length=20 cm", "crease_angle=60 deg"}), Contains("remeshed to"));
  run({"cut", "even.obj", "-o", "half.vtk", "normal=[0, 1, 0]"});
  run({"union", "half.vtk", "whole.stl", "-o", "both.off", "place.translate=[3, 0, 0]"});
  CHECK_THAT(run({"tetrahedralize", "both.off", "-o", "tets.vtu", "edge_length=0.3"}), Contains("dihedral angles from"));
  const Mesh tets = read_mesh(folder.path() / "tets.vtu");
  CHECK(tets.tets.size() > 500);
  CHECK(inverted_tets(tets).empty());
}

TEST_CASE("tack mesh refuses bad calls and bad meshes with a remedy") {
  const TemporaryFolder folder;
  write_mesh(folder.path() / "open.obj", with_hole());
  const auto error = [&](const Arguments& words) {
    Arguments all = {"mesh"};
    all.insert(all.end(), words.begin(), words.end());
    const ProgramResult r = run_tack(folder.path(), all);
    CHECK(r.exit_code == 2);
    return r.err;
  };
  CHECK_THAT(error({"remsh", "open.obj"}), Contains("remesh"));
  CHECK_THAT(error({"remesh"}), Contains("which mesh"));
  CHECK_THAT(error({"remesh", "open.obj", "edge_length=1"}), Contains("-o FILE"));
  CHECK_THAT(error({"remesh", "open.obj", "-o", "a.obj"}), Contains("edge_length"));
  CHECK_THAT(error({"remesh", "open.obj", "-o", "a.obj", "edge_lenght=1"}), Contains("edge_length"));
  CHECK_THAT(error({"remesh", "open.obj", "open.obj", "-o", "a.obj", "edge_length=1"}), Contains("with"));
  CHECK_THAT(error({"remesh", "open.obj", "-o", "a.xyz", "edge_length=1"}), Contains("unknown mesh format"));
  CHECK_THAT(error({"tetrahedralize", "open.obj", "-o", "a.vtu", "edge_length=1"}), Contains("3 open edges") && Contains("repair"));
  CHECK_THAT(error({"info"}), Contains("which mesh"));
  CHECK_FALSE(std::filesystem::exists(folder.path() / "a.vtu"));
}

TEST_CASE("a creature of ten thousand good tets comes out of one file") {
  const TemporaryFolder folder;
  const ProgramResult r = run_tack(folder.path(), {"check", TACK_SOURCE_DIR "/experiments/meshing/creature.yaml"});
  INFO(r.out << r.err);
  REQUIRE(r.exit_code == 0);
  const auto number = [&](const std::string& before) {
    std::smatch found;
    REQUIRE(std::regex_search(r.out, found, std::regex(before + "([-+0-9.e]+)")));
    return std::stod(found[1]);
  };
  CHECK(number("triangles filled with ") > 10000);
  CHECK(std::abs(number("filled with .*m.3, ")) < 1);  // percent of the volume
  CHECK(number("from the old surface to the new: at most ") <= 1.3e-3);
  CHECK(number("; back: at most ") <= 1.3e-3);
  const auto tets = r.out.find("filled with");
  const std::string after = r.out.substr(tets);
  std::smatch angle;
  REQUIRE(std::regex_search(after, angle, std::regex("dihedral angles from ([0-9.]+) to")));
  CHECK(std::stod(angle[1]) > 8);
  CHECK_FALSE(contains(after, "warning"));
}
