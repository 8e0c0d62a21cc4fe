#include <catch2/catch.hpp>
#include <cstring>
#include <nlohmann/json.hpp>

#include "framework/export/usd_prim.hpp"
#include "tests/support/exported_run.hpp"

using namespace tack;
namespace fs = std::filesystem;

namespace {

// Returns the points of a prim at a time code of a .usda file.
std::vector<Vec3> usd_points(const std::string& text, const std::string& prim, const std::string& code) {
  size_t at = text.find("def " + prim);
  REQUIRE(at != text.npos);
  at = text.find("points.timeSamples", at);
  at = text.find("\n            " + code + ": [", at) + code.size() + 16;
  std::vector<Vec3> points;
  const std::string line = text.substr(at, text.find('\n', at) - at);
  for (size_t p = line.find('('); p != line.npos; p = line.find('(', p + 1)) {
    Vec3 x;
    REQUIRE(std::sscanf(line.c_str() + p, "(%lf, %lf, %lf)", &x[0], &x[1], &x[2]) == 3);
    points.push_back(x);
  }
  return points;
}

nlohmann::json json_of_glb(const std::string& bytes) {
  std::uint32_t words[5] = {};
  REQUIRE(bytes.size() > 20);
  std::memcpy(words, bytes.data(), 20);
  CHECK(bytes.substr(0, 4) == "glTF");
  CHECK(words[2] == bytes.size());
  return nlohmann::json::parse(bytes.substr(20, words[3]));
}

}  // namespace

TEST_CASE("USD has the positions of the frames as time samples, with names, units and colours") {
  const ExportedRun run;
  REQUIRE(run.to("usd").out == "run/export/mixed.usda\n");
  const std::string text = file_text(run.path() / "run" / "export" / "mixed.usda");
  for (const char* line : {"metersPerUnit = 1\n", "timeCodesPerSecond = 100\n", "endTimeCode = 10\n", "upAxis = \"Y\"", "custom string tack:object = \"a ball\"",
                           "int[] faceVertexCounts = [4, 4]", "texCoord2f[] primvars:st = [(0, 0), (0.5, 0)", "(0.8, 0.1, 0.05)", "def GeomSubset \"red\"",
                           "int[] curveVertexCounts = [65]", "float[] widths = [0.01]", "float[] widths = [0.04]"}) {
    CAPTURE(line);
    CHECK(contains(text, line));
  }
  const std::vector<std::string> prims = {"", "Mesh \"sheet\"", "Mesh \"a_ball\"", "BasisCurves \"rod\"", "Points \"grains\""};
  for (int object = 1; object < 5; ++object)
    for (const int frame : {0, 4, 9}) {
      CAPTURE(prims[object], frame);
      CHECK(largest_difference(usd_points(text, prims[object], std::to_string(frame)), run.positions(object, frame)) < 2e-7);
    }
  REQUIRE(run.to("usd", {"-o", "mm.usda", "unit=mm", "fps=50", "from=20 ms"}).exit_code == 0);
  const std::string small = file_text(run.path() / "mm.usda");
  CHECK(contains(small, "metersPerUnit = 0.001\n"));
  CHECK(contains(small, "startTimeCode = 1\n"));
  CHECK(contains(small, "float[] widths = [40]"));
  std::vector<Vec3> x = run.positions(2, 4);
  for (Vec3& p : x) p *= 1000;
  CHECK(largest_difference(usd_points(small, "Mesh \"a_ball\"", "2"), x) < 2e-4);
  CHECK(contains(run.to("usd", {"-o", "a.usdc"}).err, "names of USD files as text end in .usda"));
  for (const auto& entry : fs::directory_iterator(run.path() / "run" / "export")) CHECK(entry.path().extension() != ".part");
}

TEST_CASE("names of USD prims are identifiers") {
  CHECK(usd_identifier("a ball") == "a_ball");
  CHECK(usd_identifier("2nd") == "_2nd");
  CHECK(usd_identifier("") == "_");
}

TEST_CASE("a scene whose gravity is along z is z up in USD, and rotated for glTF") {
  const ExportedRun run({"gravity=[0, 0, -9.81]"});
  REQUIRE(run.to("usd").exit_code == 0);
  CHECK(contains(file_text(run.path() / "run" / "export" / "mixed.usda"), "upAxis = \"Z\""));
  REQUIRE(run.to("gltf").exit_code == 0);
  const auto gltf = json_of_glb(file_text(run.path() / "run" / "export" / "mixed.glb"));
  CHECK(gltf["nodes"][0]["rotation"][0].get<double>() == Approx(-std::sqrt(0.5)));
  const ExportedRun sideways({"gravity=[-9.81, 0, 0]"});
  CHECK(contains(sideways.to("usd").out, "note: upAxis of the file is Y, because USD knows y and z alone"));
}

TEST_CASE("glTF has a morph target per further sample of what moves, and none of what does not") {
  const ExportedRun run;
  REQUIRE(run.to("gltf", {"frames=4"}).out == "run/export/mixed.glb\nnote: 4 of 11 samples are written; more by frames=N, at most 256\n");
  const auto gltf = json_of_glb(file_text(run.path() / "run" / "export" / "mixed.glb"));
  CHECK_FALSE(gltf["meshes"][0]["primitives"][0].contains("targets"));
  CHECK(gltf["meshes"][0]["name"] == "floor");
  CHECK(gltf["meshes"][2]["name"] == "a ball");
  CHECK(gltf["meshes"][2]["primitives"][0]["targets"].size() == 3);
  CHECK(gltf["animations"][0]["channels"].size() == 4);
  CHECK_FALSE(gltf["nodes"][0].contains("rotation"));
  CHECK(contains(run.to("gltf", {"frames=300"}).err, "in [2, 256]"));
}

TEST_CASE("names of materials that are not UTF-8 do not prevent an export") {
  const ExportedRun run;
  std::string latin = quads_obj;
  latin.replace(latin.find("plain"), 5, "gr\xfcn");
  write_file(run.path() / "quads.obj", latin);
  const std::string expected = "gr\xEF\xBF\xBDn";
  REQUIRE(run.to("gltf", {"frames=2"}).exit_code == 0);
  CHECK(contains(json_of_glb(file_text(run.path() / "run" / "export" / "mixed.glb"))["materials"].dump(), expected));
  REQUIRE(run.to("npy").exit_code == 0);
  CHECK(nlohmann::json::parse(file_text(run.path() / "run" / "export" / "npy" / "shapes.json"))["objects"][1]["materials"][1]["name"] == expected);
}
