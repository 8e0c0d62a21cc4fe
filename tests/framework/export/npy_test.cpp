#include <catch2/catch.hpp>
#include <cstring>
#include <nlohmann/json.hpp>

#include "tests/support/exported_run.hpp"

using namespace tack;
namespace fs = std::filesystem;

TEST_CASE("arrays for NumPy have the positions of the frames, bit by bit") {
  const ExportedRun run;
  REQUIRE(run.to("npy").out == "run/export/npy\n");
  const fs::path folder = run.path() / "run" / "export" / "npy";
  const auto shapes = nlohmann::json::parse(file_text(folder / "shapes.json"));
  CHECK(shapes["up"] == nlohmann::json({0, 1, 0}));
  REQUIRE(shapes["times"].size() == 11);
  REQUIRE(shapes["objects"].size() == 5);
  for (int object = 0; object < 5; ++object) {
    const auto& o = shapes["objects"][object];
    const std::string bytes = file_text(folder / o["positions"].get<std::string>());
    const int n = o["vertices"];
    CAPTURE(o["name"].get<std::string>());
    CHECK(bytes.substr(0, 8) == std::string("\x93NUMPY\x01\x00", 8));
    const size_t data = 10 + static_cast<unsigned char>(bytes[8]) + 256U * static_cast<unsigned char>(bytes[9]);
    CHECK(data % 64 == 0);
    CHECK(bytes[data - 1] == '\n');
    CHECK(contains(bytes.substr(0, data), "'descr': '<f8', 'fortran_order': False, 'shape': (11, " + std::to_string(n) + ", 3)"));
    REQUIRE(bytes.size() == data + 11 * 24 * static_cast<size_t>(n));
    for (const int frame : {0, 4, 10}) {
      const auto x = run.positions(object, frame);
      REQUIRE(static_cast<int>(x.size()) == n);
      CHECK(std::memcmp(bytes.data() + data + 24 * x.size() * static_cast<size_t>(frame), x.data(), 24 * x.size()) == 0);
    }
  }
  CHECK(shapes["objects"][1]["face_sizes"] == nlohmann::json({4, 4}));
  CHECK(shapes["objects"][1]["materials"][0]["name"] == "red");
  CHECK(shapes["objects"][3]["edges"].size() == 64);
  CHECK(shapes["objects"][3]["radius"] == 0.005);
  CHECK(shapes["objects"][4]["points"].size() == 18);
}
