#include <catch2/catch.hpp>

#include "geometry/io/mesh_io.hpp"
#include "geometry/io/file_faces.hpp"
#include "tests/support/exported_run.hpp"

using namespace tack;
namespace fs = std::filesystem;

TEST_CASE("sequences of mesh files have the positions of the frames") {
  const ExportedRun run;
  REQUIRE(run.to("obj").exit_code == 0);
  REQUIRE(run.to("ply").exit_code == 0);
  const fs::path folder = run.path() / "run" / "export";
  for (int object = 0; object < 5; ++object) {
    const std::string& name = exported_files[object];
    CAPTURE(name);
    for (const int frame : {0, 4, 9}) {
      const std::string file = name + "_00000" + std::to_string(frame);
      const auto x = run.positions(object, frame);
      CHECK(largest_difference(read_mesh(folder / "obj" / (file + ".obj")).vertices, x) < 1e-8);
      const std::string ply = file_text(folder / "ply" / (file + ".ply"));
      const size_t data = ply.find("end_header\n") + 11;
      REQUIRE(ply.size() >= data + 24 * x.size());
      CHECK(std::memcmp(ply.data() + data, x.data(), 24 * x.size()) == 0);  // bit by bit
    }
  }
  CHECK(fs::exists(folder / "obj" / "floor_000010.obj"));
  write_file(folder / "obj" / "floor_of_mine.obj", "v 0 0 0\n");
  REQUIRE(run.to("obj", {"to=0.05"}).exit_code == 0);  // a shorter sequence leaves none of the longer one
  CHECK(fs::exists(folder / "obj" / "floor_000001.obj"));
  CHECK_FALSE(fs::exists(folder / "obj" / "floor_000010.obj"));
  CHECK(fs::exists(folder / "obj" / "floor_of_mine.obj"));
  REQUIRE(run.to("obj").exit_code == 0);
  CHECK_FALSE(fs::exists(folder / "obj" / "floor_000011.obj"));
  for (const char* name : {"a_ball_000003", "sheet_000003"})
    CHECK(read_mesh(folder / "ply" / (std::string(name) + ".ply")).triangles == read_mesh(folder / "obj" / (std::string(name) + ".obj")).triangles);
  CHECK(read_mesh(folder / "obj" / "rod_000000.obj").edges.size() == 64);
  CHECK(read_mesh(folder / "obj" / "grains_000000.obj").points.size() == 18);
}

TEST_CASE("an object from an .obj file keeps its polygons, texture coordinates and materials, the right way round") {
  const ExportedRun run;
  REQUIRE(run.to("obj").out == "run/export/obj\n");
  const fs::path file = run.path() / "run" / "export" / "obj" / "sheet_000007.obj";
  const FileFaces faces = read_file_faces(file), source = read_file_faces(run.path() / "quads.obj");
  CHECK(faces.sizes == source.sizes);
  CHECK(faces.uvs == source.uvs);
  CHECK(faces.materials == source.materials);
  CHECK(contains(file_text(file.parent_path() / "sheet.mtl"), "newmtl red\nKd 0.8 0.1 0.05\n"));
  // The scene mirrors the sheet, so its faces run the other way round; each corner keeps its texture coordinates.
  CHECK(faces.corners == std::vector<int>{1, 4, 3, 0, 2, 5, 4, 1});
  CHECK(faces.corner_uvs == faces.corners);
  const Mesh frame = read_frame(run.path() / "run" / "frames" / "frame_000007.vtu").mesh, mesh = read_mesh(file);
  const auto up = [](const Mesh& m, const Triangle& t) { return (m.vertices[t[1]] - m.vertices[t[0]]).cross(m.vertices[t[2]] - m.vertices[t[0]])[1] > 0; };
  CHECK(up(mesh, mesh.triangles[0]) == up(frame, frame.triangles[12]));  // the floor has the first twelve
}

TEST_CASE("an object whose .obj file is not what was simulated is written as triangles, with a note") {
  const ExportedRun run;
  write_file(run.path() / "quads.obj", "v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 3\n");
  const ProgramResult other = run.to("obj");
  CHECK(contains(other.out, "note: object 'sheet' is written as triangles: "));
  CHECK(contains(other.out, "has other triangles than what was simulated"));
  CHECK(read_file_faces(run.path() / "run" / "export" / "obj" / "sheet_000000.obj").sizes == std::vector<int>(4, 3));
  fs::remove(run.path() / "quads.obj");
  CHECK(contains(run.to("obj").out, "quads.obj is not there any more"));
}

TEST_CASE("texture coordinates of .obj files are read as they stand there") {
  const TemporaryFolder folder;
  write_file(folder.path() / "a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nf -4/-3/1 2/2/1 3/3/1\nusemtl m\nf 1 3 4\n");
  const FileFaces faces = read_file_faces(folder.path() / "a.obj");
  CHECK(faces.corner_uvs == std::vector<int>{0, 1, 2, -1, -1, -1});
  CHECK(faces.corners == std::vector<int>{0, 1, 2, 0, 2, 3});
  CHECK(faces.material == std::vector<int>{-1, 0});
  write_file(folder.path() / "b.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\nf 1/1 2/2 3/1\n");
  CHECK_THROWS_WITH(read_file_faces(folder.path() / "b.obj"), Catch::Contains("b.obj:5: \"2/2\" refers to no texture coordinates above it"));
}

TEST_CASE("polygons of .ply and .off files are kept") {
  const ExportedRun run;
  REQUIRE(run.to("ply", {"objects=[sheet]"}).exit_code == 0);
  // The exported quads become the mesh of another scene.
  const fs::path quads = run.path() / "run" / "export" / "ply" / "sheet_000000.ply";
  CHECK(read_file_faces(quads).sizes == std::vector<int>{4, 4});
  CHECK(read_file_faces(quads).corners == std::vector<int>{1, 4, 3, 0, 2, 5, 4, 1});
  write_file(run.path() / "quads.off", "OFF\n6 2 0\n0 0 0\n1 0 0\n2 0 0\n0 0 1\n1 0 1\n2 0 1\n4 0 3 4 1\n4 1 4 5 2\n");
  for (const std::string& file : {quads.string(), (run.path() / "quads.off").string()}) {
    CAPTURE(file);
    write_file(run.path() / "again.yaml", "name: again\ntime: {step: 10 ms, duration: 10 ms}\nobjects: [{name: sheet, shape: {type: file, path: " + file + "}, energies: [{type: neo_hookean_membrane, young: 1 MPa, density: 1000}], shell: {thickness: 1 mm}}]\n");
    REQUIRE(run_tack(run.path(), {"run", "again.yaml", "-q", "-o", "again"}).exit_code == 0);
    REQUIRE(run_tack(run.path(), {"export", "again", "--to", "obj", "-o", "obj"}).out == "obj\n");
    const FileFaces faces = read_file_faces(run.path() / "obj" / "sheet_000001.obj");
    CHECK(faces.corners == read_file_faces(file).corners);
    CHECK(faces.sizes == std::vector<int>{4, 4});
  }
}
