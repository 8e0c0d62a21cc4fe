#include "framework/measured/measured_data.hpp"

#include <catch2/catch.hpp>

#include "framework/config/bind.hpp"
#include "framework/config/parse.hpp"
#include "tests/framework/config/toy.hpp"
#include "tests/support/program.hpp"

using namespace tack;
using Catch::Contains;
using toy::message_of;

namespace {

class File {
 public:
  explicit File(const std::string& text) { write_file(path(), text); }
  std::string path() const { return (folder_.path() / "load.csv").string(); }
  MeasuredData data(const std::string& more) const {
    MeasuredData d;
    bind(parse_string("{file: " + path() + more + "}", "s.yaml"), d, "follows");
    return d;
  }
  MeasuredCurve read(const std::string& more = "") const { return data(more).read("opening", units::length, "load", units::force); }

 private:
  TemporaryFolder folder_;
};

const char* text = "# measured by hand\nopening [mm], load [kN]\n1, 2\n3, 4\n2, 1\n";

}  // namespace

TEST_CASE("measured data are in SI, in the order of their file, with line numbers", "[measured]") {
  const MeasuredCurve curve = File(text).read();
  REQUIRE(curve.size() == 3);
  CHECK(curve.x[2] == Approx(2e-3));
  CHECK(curve.y == std::vector<double>{2000, 4000, 1000});
  CHECK_THAT(curve.location(1), Contains("load.csv:4"));
}

TEST_CASE("from and to select points of the data", "[measured]") {
  const MeasuredCurve curve = File(text).read(", from: 2 mm, to: 3 mm");
  CHECK(curve.y == std::vector<double>{4000, 1000});
  CHECK(curve.lines == std::vector<int>{4, 5});
  CHECK_THAT(message_of([&] { File(text).read(", from: 5 mm"); }), Contains("no point lies between from and to; its opening goes from 0.001 to 0.003"));
  CHECK_THAT(message_of([&] { File(text).read(", from: 5 mm, to: 2 mm"); }), Contains("is above to"));
}

TEST_CASE("errors in a file of measured data are reported", "[measured]") {
  CHECK_THAT(message_of([&] { File("opening [mm], load [kN]\n").read(); }), Contains("load.csv: has no row of numbers"));
  CHECK_THAT(message_of([&] { File("opening [mm], load [mm]\n1, 2\n").read(); }), Contains("column 'load': expects a force (N), got '1 mm', which is a length"));
  CHECK_THAT(message_of([&] { File("opening [mm], force [N]\n1, 2\n").read(); }), Contains("no column 'load'") && Contains("y_column"));
  CHECK(File("opening [mm], force [N]\n1, 2\n").read(", y_column: force").y[0] == 2);
  CHECK(File("delta [mm], load [N]\n1, 2\n").read(", x_column: delta").x[0] == Approx(1e-3));
}
