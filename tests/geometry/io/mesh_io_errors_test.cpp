#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "geometry/errors.hpp"
#include "geometry/io/mesh_io.hpp"
#include "tests/support/silence.hpp"

using namespace tack;
using Catch::Matchers::Contains;

namespace {

// Reads a file of that content in a fresh folder; its name must be in the message, and the
// libraries behind the formats must print nothing.
void check_refused(const std::string& name, const std::string& content,
                   const std::string& message) {
  const TemporaryFolder folder;
  const auto path = folder.path() / name;
  std::ofstream(path, std::ios::binary) << content;
  INFO(name << ": " << message);
  std::string error;
  const std::string printed = printed_by([&] {
    try {
      read_mesh(path);
    } catch (const InputError& refused) {
      error = refused.what();
    }
  });
  CHECK_THAT(error, Contains(path.string()) && Contains(message));
  CHECK(printed == "");
}

std::string garbage() {
  std::string bytes = "\x7f\x01\xff\xfe";
  for (int i = 0; i < 2000; ++i) bytes += static_cast<char>(17 + i * 7919 % 251);
  return bytes;
}

const char* const all[] = {"a.obj", "a.ply", "a.off", "a.stl", "a.glb", "a.gltf", "a.vtk", "a.vtu", "a.msh"};

}  // namespace

TEST_CASE("a missing file, a folder and an unknown format are refused", "[io]") {
  const TemporaryFolder folder;
  for (const char* name : all) {
    CHECK_THROWS_WITH(read_mesh(folder.path() / name), Contains("no such") && Contains(name));
  }
  std::filesystem::create_directory(folder.path() / "a.msh");
  CHECK_THROWS_WITH(read_mesh(folder.path() / "a.msh"), Contains("cannot be read"));
  check_refused("a.step", "ISO", "unknown mesh format \".step\": convert it to one of .obj .ply");
  check_refused("mesh", "v 0 0 0", "unknown mesh format");
}

TEST_CASE("empty, blank and garbage files are refused in every format", "[io]") {
  for (const char* name : all) {
    check_refused(name, "", "is empty");
    check_refused(name, "\n \n", "");
    check_refused(name, garbage(), "");
    check_refused(name, std::string(300, '\0'), "");
  }
}

TEST_CASE("obj errors name the line", "[io]") {
  check_refused("a.obj", "v 0 0\n", "a.obj:1: a vertex needs three");
  check_refused("a.obj", "v 0 0 0\nv 1 0 zero\n", "a.obj:2: \"zero\" is no finite number");
  check_refused("a.obj", "v 0 0 nan\n", "no finite number");
  check_refused("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n", ":4: refers to vertex 4 of 3");
  check_refused("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 0\n", "refers to vertex 0");
  check_refused("a.obj", "v 0 0 0\nv 1 0 0\nl 1 -3\n", "refers to vertex -3");
  check_refused("a.obj", "v 0 0 0\nv 1 0 0\nf 1 2\n", "a.obj:3: a polygon of 2 vertices");
  check_refused("a.obj", "v 0 0 0\nl 1\n", "at least two");
  check_refused("a.obj", "v 0 0 0\nl 1 x\n", "\"x\" is no vertex number");
  check_refused("a.obj", "v 0 0 0\ncurv2 1\n", "\"curv2\" is no statement");
  check_refused("a.obj", "# only a comment\n", "no vertex found");
}

TEST_CASE("cut, wrong and out-of-range polygon files are refused", "[io]") {
  const std::string ply = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
                          "property float y\nproperty float z\nelement face 1\n"
                          "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n";
  check_refused("a.ply", ply, "not a valid .ply");
  check_refused("a.ply", "ply\nformat ascii 1.0\nproperty float x\nend_header\n",
                "belongs to no element");
  check_refused("a.ply", "ply\nformat ascii 1.0\nelement vertex\nend_header\n", "no count");
  check_refused("a.ply", ply + "0 1 0\n3 0 1 3\n", "face 0 refers to vertex 3");
  check_refused("a.ply", ply + "0 1 0\n3 0 1 -1\n", "face 0 refers to vertex");
  check_refused("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n", "not a valid .off");
  check_refused("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n", "");
}

TEST_CASE("unsupported cells are named", "[io]") {
  const auto folder = std::filesystem::path(TACK_TEST_DATA) / "meshes";
  CHECK_THROWS_WITH(read_mesh(folder / "hexahedron.vtk"),
                    Contains("cell 0 is a vtkHexahedron") && Contains("supported are"));
  CHECK_THROWS_WITH(read_mesh(folder / "hexahedron.msh"),
                    Contains("Hexahedron") && Contains("supported are"));
  check_refused("a.vtk", "# vtk DataFile Version 3.0\nx\nASCII\nDATASET STRUCTURED_POINTS\n"
                         "DIMENSIONS 2 2 2\nORIGIN 0 0 0\nSPACING 1 1 1\n",
                "give an unstructured grid");
}

TEST_CASE("vtk, vtu and stl files that are cut or wrong are refused", "[io]") {
  const std::string vtk = "# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\n"
                          "POINTS 3 double\n0 0 0  1 0 0  0 1 ";
  check_refused("a.vtk", vtk, "not a valid file");
  check_refused("a.vtk", vtk + "0\nCELLS 1 3\n3 0 1 2\n", "CELLS does not hold the 3 numbers");
  check_refused("a.vtk", vtk + "0\nCELLS 1 4\n3 0 1 2\nCELL_TYPES 1\n10\n",
                "has 3 vertices, but its kind has 4");
  check_refused("a.vtk", vtk + "nan\nCELLS 1 4\n3 0 1 2\nCELL_TYPES 1\n5\n", "not a valid file");
  check_refused("a.vtk", vtk + "0\nCELLS 1 4\n3 0 1 9\nCELL_TYPES 1\n5\n", "refers to vertex 9");
  check_refused("a.vtu", "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\">\n<Unstruct",
                "not a valid file");
  check_refused("a.vtu", "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\"></VTKFile>\n", "");
  check_refused("a.stl", "solid x\n facet normal 0 0 1\n outer loop\n vertex 0 0\n", "");
  const std::string polygons = "# vtk DataFile Version 3.0\nx\nASCII\nDATASET POLYDATA\n"
                               "POINTS 3 double\n0 0 0  1 0 0  0 1 0\nPOLYGONS 1 ";
  check_refused("a.vtk", polygons + "4\n3 0 1", "POLYGONS does not hold the 4 numbers");
  check_refused("a.vtk", polygons + "5\n3 0 1 2\n", "POLYGONS does not hold the 5 numbers");
  check_refused("a.vtk", polygons + "4\n3 0 1 7\n", "cell 0 refers to vertex 7");
  std::string stl(134, '\0');  // header, number of triangles, one triangle of equal corners
  stl[80] = 1;
  check_refused("a.stl", stl, "no triangle found");
  for (int i : {98, 99}) stl[i] = '\x7f';  // a NaN
  for (int i : {96, 97}) stl[i] = '\x01';
  stl[98] = '\xff';
  check_refused("a.stl", stl, "coordinates have to be finite");
  check_refused("a.stl", stl.substr(0, 100), "a binary .stl file of 1 triangles has 134");
}

TEST_CASE("glTF files that are cut, compressed or of another version are refused", "[io]") {
  const auto whole = std::filesystem::path(TACK_TEST_DATA) / "meshes" / "nodes.gltf";
  std::ifstream file(whole);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  check_refused("a.gltf", text.substr(0, 1000), "not a valid file of its format");
  const auto with = [&](const std::string& before, const std::string& after) {
    std::string changed = text;
    REQUIRE(changed.find(before) != changed.npos);
    return changed.replace(changed.find(before), before.size(), after);
  };
  check_refused("a.gltf", with("\"version\": \"2.0\"", "\"version\": \"1.0\""), "glTF version");
  check_refused("a.gltf", with("\"POSITION\": 0", "\"POSITION\": 9"), "");
  check_refused("a.gltf", with("\"byteLength\": 12", "\"byteLength\": 1200"), "view 2 goes beyond its buffer");
  check_refused("a.gltf", with("\"byteLength\": 156", "\"byteLength\": 1200"), "buffer 0 has less than the 1200 bytes");
  check_refused("a.gltf", with("\"count\": 3", "\"count\": 300"), "accessor 0 goes beyond its view");
  check_refused("a.gltf", with("\"bufferView\": 2", "\"bufferView\": 7"), "");
  check_refused("a.glb", "glTF", "it has 4 bytes");
  check_refused("a.gltf", with("\"asset\"", "\"\xd4\x1b[31m"), "last read: '\"?");  // not to the terminal
  check_refused("a.gltf", with("\"asset\"", "\"extensionsRequired\": [\"KHR_draco_mesh_compression\"], \"asset\""), "KHR_draco_mesh_compression is required");
}

TEST_CASE("gmsh files of other versions, scripts and cut files are refused", "[io]") {
  check_refused("a.msh", "$MeshFormat\n1.0 0 8\n$EndMeshFormat\n", "version 2.2 or 4.1 (but 1)");
  check_refused("a.msh", "Point(1) = {0, 0, 0};\n", "not a Gmsh mesh");
  check_refused("a.msh", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n2\n1 0 0 0\n", "a.msh");
  check_refused("a.msh", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n1\n1 0 0 0\n$EndNodes\n"
                         "$Elements\n1\n1 1 2 0 1 1 2\n$EndElements\n",
                "element 1 uses node 2, which is not defined");
}

TEST_CASE("a strongly concave polygon is refused, a concave quad is not", "[io]") {
  check_refused("a.obj",
                "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 3 1 0\nv 2 4 0\nv 1 1 0\nv 0 4 0\nf 1 2 3 4 5 6 7\n",
                "cut it into triangles");
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "dart.obj") << "v 0 0 0\nv 2 -1 0\nv 1 0 0\nv 2 1 0\nf 2 3 4 1\n";
  const Mesh dart = read_mesh(folder.path() / "dart.obj");
  CHECK(dart.triangles == std::vector<Triangle>{{2, 3, 0}, {2, 0, 1}});
}

TEST_CASE("counts that no file could hold are refused in every format", "[io]") {
  const auto vtk = [](const std::string& version, const std::string& points, const std::string& cells) {
    return "# vtk DataFile Version " + version + "\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS " + points +
           " double\n0 0 0  1 0 0  0 1 0\nCELLS " + cells + "\n3 0 1 2\nCELL_TYPES 1\n5\n";
  };
  for (const char* version : {"-1", "-1e308", "99"}) check_refused("a.vtk", vtk(version, "3", "1 4"), "version");
  for (const char* count : {"-2147483648", "-1", "4294967296", "999999999999"}) check_refused("a.vtk", vtk("3.0", count, "1 4"), "");
  for (const char* count : {"-2147483648 4", "999999999999 4", "1 9223372036854775807", "1 -4"})
    check_refused("a.vtk", vtk("3.0", "3", count), "");
  for (const char* count : {"-2147483648", "1000000000000"})
    check_refused("a.msh", "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n" + std::string(count) +
                           " 1 \"x\"\n$EndPhysicalNames\n", "");
  const auto vtu = [](const std::string& points, const std::string& cells) {
    return "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\"><UnstructuredGrid><Piece "
           "NumberOfPoints=\"" + points + "\" NumberOfCells=\"" + cells + "\"><Points><DataArray type=\"Float64\" "
           "NumberOfComponents=\"3\" format=\"ascii\">0 0 0 1 0 0 0 1 0</DataArray></Points><Cells><DataArray "
           "type=\"Int64\" Name=\"connectivity\" format=\"ascii\">0 1 2</DataArray><DataArray type=\"Int64\" "
           "Name=\"offsets\" format=\"ascii\">3</DataArray><DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">5"
           "</DataArray></Cells></Piece></UnstructuredGrid></VTKFile>\n";
  };
  for (const char* count : {"-2147483648", "4294967296"}) {
    check_refused("a.vtu", vtu(count, "1"), "");
    check_refused("a.vtu", vtu("3", count), "");
  }
  std::string stl(134, '\0');
  for (int i = 80; i < 84; ++i) stl[i] = '\xff';
  check_refused("a.stl", stl, "a binary .stl file of 4294967295 triangles");
}
