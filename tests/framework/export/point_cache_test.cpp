#include <bit>
#include <catch2/catch.hpp>
#include <cstring>
#include <regex>

#include "framework/output/output_format.hpp"
#include "geometry/io/mesh_io.hpp"
#include "tests/support/exported_run.hpp"

using namespace tack;
namespace fs = std::filesystem;

namespace {

constexpr double single_precision = 2e-7;  // m, of coordinates up to 3 m

// Numbers of four bytes in a file.
class Words {
 public:
  Words(const fs::path& path, bool big_endian) : bytes_(file_text(path)), big_endian_(big_endian) {}
  std::int32_t integer(size_t at) const { return std::bit_cast<std::int32_t>(word(at)); }
  float number(size_t at) const { return std::bit_cast<float>(word(at)); }
  size_t size() const { return bytes_.size(); }
  std::string text(size_t at, size_t count) const { return bytes_.substr(at, count); }
  std::vector<Vec3> points(size_t at, int count) const {
    std::vector<Vec3> x;
    for (int v = 0; v < count; ++v, at += 12) x.emplace_back(number(at), number(at + 4), number(at + 8));
    return x;
  }

 private:
  std::uint32_t word(size_t at) const {
    std::uint32_t w = 0;
    std::memcpy(&w, bytes_.substr(at, 4).data(), 4);
    return big_endian_ ? __builtin_bswap32(w) : w;
  }
  std::string bytes_;
  bool big_endian_;
};

}  // namespace

TEST_CASE("point caches have all samples of each object, and its mesh in the same order") {
  const ExportedRun run;
  REQUIRE(run.result.exit_code == 0);
  const ProgramResult exported = run.to("pc2");
  CHECK(exported.out == "run/export/pc2\n");
  REQUIRE(run.to("mdd", {"-o", "caches"}).out == "caches\n");
  for (int object = 0; object < 5; ++object) {
    const std::string& name = exported_files[object];
    CAPTURE(name);
    const fs::path folder = run.path() / "run" / "export" / "pc2";
    const Mesh mesh = read_mesh(folder / (name + ".obj"));
    const int n = static_cast<int>(mesh.vertices.size());
    CHECK(largest_difference(mesh.vertices, run.positions(object, 0)) < 1e-8);
    const Words pc2(folder / (name + ".pc2"), false), mdd(run.path() / "caches" / (name + ".mdd"), true);
    CHECK((pc2.text(0, 12) == std::string("POINTCACHE2\0", 12)));
    CHECK(pc2.integer(12) == 1);
    CHECK(pc2.integer(16) == n);
    CHECK(pc2.number(20) == 0);
    CHECK(pc2.number(24) == 1);
    CHECK(pc2.integer(28) == 11);
    REQUIRE(pc2.size() == 32 + size_t(11) * n * 12);
    CHECK(mdd.integer(0) == 11);
    CHECK(mdd.integer(4) == n);
    REQUIRE(mdd.size() == 8 + 11 * 4 + size_t(11) * n * 12);
    for (const int frame : {0, 4, 9}) {
      CAPTURE(frame);
      const auto x = run.positions(object, frame);
      CHECK(mdd.number(8 + 4 * frame) == Approx(0.01 * frame));
      CHECK(largest_difference(pc2.points(32 + size_t(12) * n * frame, n), x) < single_precision);
      CHECK(largest_difference(mdd.points(8 + 44 + size_t(12) * n * frame, n), x) < single_precision);
    }
  }
  // A moving object differs from frame to frame: the comparison above is no comparison of equals.
  CHECK(largest_difference(run.positions(1, 0), run.positions(1, 4)) > 1e-3);
}

TEST_CASE("samples per second are interpolated between frames, in the unit and for the objects that are asked for") {
  const ExportedRun run;
  REQUIRE(run.to("pc2", {"fps=250", "from=10 ms", "to=50 ms", "objects=[sheet]", "unit=mm"}).exit_code == 0);
  const fs::path folder = run.path() / "run" / "export" / "pc2";
  CHECK_FALSE(fs::exists(folder / "floor.pc2"));
  const Words cache(folder / "sheet.pc2", false);
  REQUIRE(cache.integer(28) == 11);  // at 10, 14, ... 50 ms
  const auto a = run.positions(1, 1), b = run.positions(1, 2);
  auto expected = a;
  for (size_t v = 0; v < a.size(); ++v) expected[v] = 1000 * (a[v] + 0.8 * (b[v] - a[v]));
  CHECK(largest_difference(cache.points(32 + 12 * 6 * 2, 6), expected) < 1000 * single_precision);
  for (Vec3& p : expected = run.positions(1, 5)) p *= 1000;
  CHECK(largest_difference(cache.points(32 + 12 * 6 * 10, 6), expected) < 1000 * single_precision);
}

TEST_CASE("a run makes the formats of its scene when it ends, and refuses what they cannot be before it begins") {
  const ExportedRun run({"output.formats=[vtu, {type: pc2, objects: [rod]}]"});
  REQUIRE(run.result.exit_code == 0);
  CHECK(fs::exists(run.path() / "run" / "export" / "pc2" / "rod.pc2"));
  CHECK_FALSE(fs::exists(run.path() / "run" / "export" / "pc2" / "sheet.pc2"));
  const ExportedRun unknown({"output.formats=[vtu, {type: pc2, objects: [road]}]"});
  CHECK(unknown.result.exit_code == 2);
  CHECK(contains(unknown.result.err, "format 'pc2', objects: unknown object 'road'; did you mean 'rod'?"));
  CHECK_FALSE(fs::exists(unknown.path() / "run"));
  CHECK(contains(ExportedRun({"output.formats=[pc2]"}).result.err, "expects vtu among them"));
  CHECK(contains(ExportedRun({"output.formats=[vtu, pc2, pc2]"}).result.err, "names 'pc2' twice"));
}

TEST_CASE("an export says what it lacks") {
  const ExportedRun run;
  CHECK(contains(run.to("pc3").err, "unknown format 'pc3'; did you mean 'pc2'?"));
  CHECK(contains(run.to("pc2", {"objects=[sheat]"}).err, "unknown object 'sheat'; did you mean 'sheet'?"));
  CHECK(contains(run.to("pc2", {"unit=furlong2"}).err, "expects a unit of length"));
  CHECK(contains(run.to("pc2", {"from=1 s", "to=2 s"}).err, "its frames are from 0 to 0.1 s"));
  CHECK(contains(run.to("vtu").out, "run/run.pvd"));
  CHECK(contains(run.to("pc2", {"from=0.08 s", "to=0.02 s"}).err, "from: 0.08 s is after to: 0.02 s"));
  CHECK(contains(run.to("pc2", {"fps", "24"}).err, "'fps': expects key=value, such as fps=24"));
  CHECK(contains(run.to("alembic").err, "unknown format 'alembic'"));
  CHECK(contains(run.to("alembic").err, "usd for Houdini"));
}

TEST_CASE("an export of what is no results folder says where the results are") {
  const ExportedRun run;
  const auto error_of = [&](const std::string& folder) {
    const ProgramResult result = run_tack(run.path(), {"export", folder, "--to", "pc2"});
    CHECK(result.exit_code == 2);
    return result.err;
  };
  CHECK(contains(error_of("nothing"), "nothing: there is no such folder"));
  CHECK(contains(error_of("."), "is no results folder; these are: ./run"));
  CHECK(contains(error_of("run/frames"), "run/frames: is no results folder; these are: run"));
  CHECK(contains(error_of("run/scene.yaml"), "run/scene.yaml: is a file; give the results folder"));
  CHECK(contains(error_of("run/export"), "run/export: is no results folder; these are: run") == fs::exists(run.path() / "run" / "export"));
  CHECK(run_tack(run.path(), {"export", "run/run.pvd", "--to", "pc2"}).exit_code == 0);
}

TEST_CASE("no format replaces a file that the scene reads, and no format of a folder one that no export wrote") {
  const ExportedRun run;
  const std::string before = file_text(run.path() / "quads.obj");
  fs::create_directories(run.path() / "mine");
  write_file(run.path() / "mine" / "notes.txt", "mine");
  for (const std::string& format : Registry<OutputFormat>::kind().names()) {
    if (format == "vtu") continue;
    INFO(format);
    const bool one_file = format == "usd" || format == "gltf";
    const auto to = [&](const std::string& output) { return run_tack(run.path(), {"export", "run", "--to", format, "-o", output}); };
    if (!one_file) {
      CHECK(contains(to(".").err, "holds quads.obj, which the scene reads"));
      CHECK(contains(to("mine").err, "mine: holds files that no export wrote"));
      CHECK(contains(to("quads.obj").err, "quads.obj: is a file, and this format writes a folder"));
      CHECK(to("new_" + format).exit_code == 0);
      CHECK(to("new_" + format).exit_code == 0);  // its own
    } else {
      CHECK(to(".").exit_code == 2);
      const std::string name = "one." + std::string(format == "usd" ? "usda" : "glb");
      CHECK(to(name).exit_code == 0);
      CHECK(to(name).exit_code == 0);
    }
    CHECK(file_text(run.path() / "quads.obj") == before);
  }
  // A scene that reads the file of a format of one file.
  const TemporaryFolder folder;
  REQUIRE(run.to("gltf", {"objects=[sheet]", "-o", (folder.path() / "model.glb").string()}).exit_code == 0);
  const std::string model = file_text(folder.path() / "model.glb");
  write_file(folder.path() / "scene.yaml", "name: model\ntime: {step: 10 ms, duration: 10 ms}\nobjects: [{name: m, shape: {type: file, path: model.glb}, shell: {thickness: 1 mm},\n"
              "  energies: [{type: neo_hookean_membrane, young: 1 MPa, poisson: 0.3, density: 1000}]}]\n");
  REQUIRE(run_tack(folder.path(), {"run", "scene.yaml", "-q", "-o", "run"}).exit_code == 0);
  CHECK(contains(run_tack(folder.path(), {"export", "run", "--to", "gltf", "-o", "model.glb"}).err, "model.glb: the scene reads this file"));
  CHECK(file_text(folder.path() / "model.glb") == model);
}

TEST_CASE("an export of a run that ended early, or whose frames are damaged, says so") {
  const ExportedRun run;
  CHECK_FALSE(contains(run.to("pc2").out, "note: the run"));
  const std::string summary = file_text(run.path() / "run" / "summary.json");
  write_file(run.path() / "run" / "summary.json", std::regex_replace(summary, std::regex("\"status\": \"done\""), "\"status\": \"simulation failed\""));
  CHECK(contains(run.to("pc2").out, "note: the run ended early (simulation failed); its frames reach to 0.1 s"));
  fs::remove(run.path() / "run" / "summary.json");
  CHECK(contains(run.to("pc2").out, "note: the run has not ended; its frames reach to 0.1 s"));
  const fs::path frame = run.path() / "run" / "frames" / "frame_000002.vtu";
  REQUIRE(fs::exists(frame));
  fs::resize_file(frame, fs::file_size(frame) / 2);
  const ProgramResult damaged = run.to("pc2");
  CHECK(damaged.exit_code == 2);
  CHECK(contains(damaged.err, "frame_000002.vtu: the frame at 0.02 s cannot be read"));
  fs::remove(frame);
  CHECK(contains(run.to("pc2").err, "frame_000002.vtu: the frame at 0.02 s is missing; leave it out by from=..."));
}

TEST_CASE("an export of a file in another unit says how to write it as it was") {
  const ExportedRun run({"objects.sheet.shape.unit=dm"});
  REQUIRE(run.result.exit_code == 0);
  CHECK(contains(run.to("obj").out, "note: object 'sheet' was read from a file in dm and is written in m; unit=dm writes it as it was"));
  CHECK_FALSE(contains(run.to("obj", {"unit=dm"}).out, "note: object 'sheet' was read"));
}

