// tack mesh from the command line.
#include <catch2/catch.hpp>
#include <regex>

#include "geometry/io/mesh_io.hpp"
#include "geometry/io/write_mesh.hpp"
#include "geometry/mesh/quality.hpp"
#include "geometry/meshing/defects.hpp"
#include "geometry/meshing/mesh_warnings.hpp"
#include "geometry/shapes/solids.hpp"
#include "geometry/shapes/surfaces.hpp"
#include "tests/support/broken_meshes.hpp"
#include "tests/support/json.hpp"
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

TEST_CASE("tack mesh turns a broken file into tets of good angles") {
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

TEST_CASE("a mesh in other units is noticed by its size, and scaled") {
  const TemporaryFolder folder;
  Mesh ball = with_hole();
  scale(ball, Vec3::Constant(1000));
  write_mesh(folder.path() / "mm.obj", ball);
  const ProgramResult large = run_tack(folder.path(), {"mesh", "remesh", "mm.obj", "-o", "a.obj", "edge_length=5 mm"});
  CHECK(large.exit_code == 2);
  CHECK_THAT(large.err, Contains("m large, was made in other units, such as millimetres, scale it first") && Contains("tack mesh scale FILE factor=0.001"));
  const ProgramResult small = run_tack(folder.path(), {"mesh", "scale", "mm.obj", "-o", "m.obj", "factor=0.001"});
  INFO(small.out << small.err);
  REQUIRE(small.exit_code == 0);
  const Mesh back = read_mesh(folder.path() / "m.obj");
  CHECK((bounding_box(back).sizes() - bounding_box(with_hole()).sizes()).norm() < 1e-12);
  CHECK(back.triangles == with_hole().triangles);
  CHECK(run_tack(folder.path(), {"mesh", "scale", "mm.obj", "-o", "a.obj", "factor=0"}).exit_code == 2);
}

TEST_CASE("an open sheet is not closed by triangles that lie on it") {
  const TemporaryFolder folder;
  Mesh sheet;
  sheet.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  sheet.triangles = {{0, 1, 2}, {0, 2, 3}};
  write_mesh(folder.path() / "sheet.obj", sheet);
  const ProgramResult closed = run_tack(folder.path(), {"mesh", "repair", "sheet.obj", "-o", "a.obj", "holes=fill"});
  CHECK(closed.exit_code == 2);
  CHECK_THAT(closed.err, Contains("the part at (0, 0, 0) is an open sheet") && Contains("holes=keep"));
  CHECK_FALSE(std::filesystem::exists(folder.path() / "a.obj"));
  for (const char* holes : {"holes=keep", "holes=of_solids"}) {
    const ProgramResult open = run_tack(folder.path(), {"mesh", "repair", "sheet.obj", "-o", "a.obj", holes});
    CHECK(open.exit_code == 0);
    CHECK_THAT(open.out, Contains("left 1 holes open"));
    CHECK(read_mesh(folder.path() / "a.obj").triangles.size() == 2);
  }
}

TEST_CASE("a mesh is converted between formats and units, and moved") {
  const TemporaryFolder folder;
  const auto run = [&](Arguments words) {
    words.insert(words.begin(), "mesh");
    const ProgramResult r = run_tack(folder.path(), words);
    INFO(r.out << r.err);
    CHECK(r.exit_code == 0);
    return r.out;
  };
  const auto refused = [&](Arguments words) {
    words.insert(words.begin(), "mesh");
    const ProgramResult r = run_tack(folder.path(), words);
    CHECK(r.exit_code == 2);
    return r.err;
  };
  const auto size_of = [&](const char* name) -> Vec3 { return bounding_box(read_mesh(folder.path() / name)).sizes(); };
  write_mesh(folder.path() / "part.stl", box_surface({10, 20, 40}, {2, 2, 2}));
  CHECK_THAT(run({"convert", "part.stl", "-o", "part.glb", "from=mm"}), Contains("triangles 48") && Contains("now 0.01 x 0.02 x 0.04 m"));
  run({"convert", "part.glb", "-o", "back.gltf", "to=mm"});
  run({"convert", "back.gltf", "-o", "back.ply"});
  CHECK((size_of("back.ply") - Vec3(10, 20, 40)).norm() < 1e-5);
  CHECK(read_mesh(folder.path() / "back.ply").triangles.size() == 48);
  run({"scale", "part.stl", "-o", "a.obj", "from=inch", "to=mm"});
  CHECK((size_of("a.obj") - 25.4 * Vec3(10, 20, 40)).norm() < 1e-9);
  run({"scale", "part.stl", "-o", "a.obj", "size=8 cm"});
  CHECK((size_of("a.obj") - Vec3(0.02, 0.04, 0.08)).norm() < 1e-12);
  CHECK_THAT(refused({"scale", "part.stl", "-o", "b.obj"}), Contains("Give one of factor, size and from"));
  CHECK_THAT(refused({"scale", "part.stl", "-o", "b.obj", "from=mm", "factor=2"}), Contains("Give one of factor, size and from"));
  CHECK_THAT(refused({"convert", "part.stl", "-o", "b.obj", "from=kg"}), Contains("expects a unit of length"));
  CHECK_THAT(refused({"transform", "part.stl", "-o", "b.obj"}), Contains("nothing is to be done"));
  CHECK_FALSE(std::filesystem::exists(folder.path() / "b.obj"));

  run({"transform", "part.stl", "-o", "turned.off", "axis=[0, 0, 1]", "angle=90 deg", "about=[5, 10, 0]", "translate=[0, 0, 1]"});
  const Mesh turned = read_mesh(folder.path() / "turned.off");
  CHECK((bounding_box(turned).min() - Vec3(5, 0, -19)).norm() < 1e-9);
  CHECK((bounding_box(turned).max() - Vec3(25, 10, 21)).norm() < 1e-9);
  CHECK(find_defects(turned).volume == Approx(8000));
  run({"transform", "part.stl", "-o", "mirrored.off", "mirror=[1, 1, 0]", "about=[1, 0, 0]"});
  const Mesh mirrored = read_mesh(folder.path() / "mirrored.off");
  CHECK((bounding_box(mirrored).min() - Vec3(1 - 10, 1 - 5, -20)).norm() < 1e-9);
  CHECK(find_defects(mirrored).volume == Approx(8000));  // normals outwards still

  write_mesh(folder.path() / "solid.vtu", box_tets({1, 1, 1}, {2, 2, 2}));
  CHECK_THAT(refused({"convert", "solid.vtu", "-o", "c.stl"}), Contains("cannot hold tets") && Contains("surface=true"));
  CHECK_THAT(run({"convert", "solid.vtu", "-o", "c.stl", "surface=true"}), Contains("the surface of 48 tets") && Contains("triangles 48"));
}

TEST_CASE("a mesh that does not fit the disk is reported, and the previous file stays") {
  if (!std::filesystem::exists("/dev/full")) return;
  for (const char* name : {"a.obj", "a.off", "a.ply", "a.stl", "a.glb", "a.gltf", "a.vtk", "a.vtu", "a.msh"}) {
    INFO(name);
    const TemporaryFolder folder;
    const auto path = folder.path() / name;
    write_file(path, "older");
    const bool by_itself = path.extension() == ".msh";
    std::filesystem::create_symlink("/dev/full", folder.path() / (by_itself ? "a.part.msh" : std::string(name) + ".part"));
    write_file(folder.path() / "given.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    const ProgramResult r = run_tack(folder.path(), {"mesh", "scale", "given.obj", "-o", name, "factor=2"});
    INFO(r.out << r.err);
    CHECK(r.exit_code == 2);
    CHECK_THAT(r.err, Contains("cannot be written") && Contains("the space on the disk"));
    CHECK(file_text(path) == "older");
    CHECK_FALSE(std::filesystem::exists(folder.path() / "a.part.msh"));
  }
}

TEST_CASE("tack mesh sdf writes the surface of a level set, from a file of its own or of an object") {
  const TemporaryFolder folder;
  const char* capsule = "{type: capsule, from: [0, 0, 0], to: [4 cm, 0, 0], radius: 1 cm}";
  write_file(folder.path() / "body.yaml", std::string("voxel: 4 mm\nplace: {translate: [1, 0, 0]}\nof: ") + capsule + "\n");
  write_file(folder.path() / "scene.yaml", std::string("name: s\nobjects:\n  - name: body\n    shape: {type: level_set, voxel: 2 mm, of: ") +
                                               capsule + "}\n    place: {translate: [1, 0, 0]}\n  - {name: box, shape: {type: box}}\n");
  const auto run = [&](Arguments words, int exit_code) {
    words.insert(words.begin(), {"mesh", "sdf"});
    const ProgramResult r = run_tack(folder.path(), words);
    INFO(r.out << r.err);
    CHECK(r.exit_code == exit_code);
    return r.out + r.err;
  };
  const double volume = M_PI * 1e-4 * (0.04 + 4 * 0.01 / 3);
  CHECK_THAT(run({"body.yaml", "-o", "body.vtu", "voxel=2 mm"}, 0),
             Contains("triangles") && Contains("from (0.99") && Contains("encloses") && Contains("area") && Contains("degrees") && Contains("took"));
  run({"scene.yaml", "-o", "scene.obj", "--object", "body"}, 0);
  const Mesh body = read_mesh(folder.path() / "body.vtu"), object = read_mesh(folder.path() / "scene.obj");
  CHECK(body.vertices == object.vertices);
  CHECK(find_defects(body).volume == Approx(volume).epsilon(0.01));
  CHECK_THAT(run({"body.yaml", "-o", "a.obj", "--object", "body"}, 2), Contains("body.yaml: has no `objects`"));
  CHECK_THAT(run({"scene.yaml", "-o", "a.obj"}, 2), Contains("--object NAME"));
  CHECK_THAT(run({"scene.yaml", "-o", "a.obj", "--object", "bod"}, 2), Contains("no object 'bod'; there are: body, box"));
  CHECK_THAT(run({"body.yaml", "-o", "a.obj", "voxle=2 mm"}, 2), Contains("unknown key 'voxle'") && Contains("'voxel'"));
  CHECK_THAT(run({"body.yaml"}, 2), Contains("-o FILE"));
  CHECK_THAT(run({}, 2), Contains("which level set"));
  write_file(folder.path() / "bad.yaml", "voxel: 4 mm\nof: {type: spere}\n");
  CHECK_THAT(run({"bad.yaml", "-o", "a.obj"}, 2), Contains("bad.yaml:2:") && Contains("sphere"));
  CHECK_FALSE(std::filesystem::exists(folder.path() / "a.obj"));
}

TEST_CASE("a creature of ten thousand good tets comes out of one file, and falls") {
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
  CHECK_FALSE(contains(after, std::string(mesh_warning::any)));
  // The mesh is cached now.
  const ProgramResult run = run_tack(folder.path(), {"run", TACK_SOURCE_DIR "/experiments/meshing/creature.yaml", "-o", "out", "-q", "--set",
                                                     "output.frames=false"});
  INFO(run.out << run.err);
  CHECK(run.exit_code == 0);
  const auto summary = read_json(folder.path() / "out/summary.json");
  CHECK(summary["intersections"] == 0);
  CHECK(summary["inverted_tets"] == 0);
}
