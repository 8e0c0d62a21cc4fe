#include "framework/view/growing_csv.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>

#include "framework/output/csv.hpp"
#include "tests/support/program.hpp"

using namespace tack;

namespace {

void append(const std::filesystem::path& path, const std::string& text) { std::ofstream(path, std::ios::app | std::ios::binary) << text; }

}  // namespace

TEST_CASE("a growing table yields complete rows as they are written") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "t.csv";
  GrowingCsv table(path);
  table.update();
  CHECK(table.columns().empty());
  append(path, "a,\"b, of\ntwo li");
  table.update();
  CHECK(table.columns().empty());
  append(path, "nes\"\n1,2\n3,");
  table.update();
  CHECK(table.columns() == std::vector<std::string>{"a", "b, of\ntwo lines"});
  CHECK(table.rows() == 1);
  CHECK(table.rows(0, 10) == std::vector<std::vector<double>>{{1, 2}});
  append(path, "4\n5,inf\n6\n");
  table.update();
  REQUIRE(table.rows() == 4);
  const auto ends = table.rows(1, 2);  // the first and the last of three
  REQUIRE(ends.size() == 2);
  CHECK(ends[0] == std::vector<double>{3, 4});
  CHECK(ends[1][0] == 6);
  CHECK(std::isnan(ends[1][1]));  // a cell that is missing
  CHECK(std::isinf(table.rows(1, 3)[1][1]));
  CHECK(table.rows(4, 10).empty());
  CHECK(table.generation() == 0);
}

TEST_CASE("a replaced file begins a new generation") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "t.csv";
  CsvFile first(path, {{"x"}, {}});
  GrowingCsv table(path);
  for (const double x : {1.0, 2.0, 3.0}) first.add(std::vector<double>{x});
  table.update();
  CHECK(table.rows() == 3);
  CsvFile second(path, {{"x"}, {{1}}});  // as when a run is gone on with from its first step
  second.add(std::vector<double>{7});
  table.update();
  CHECK(table.generation() == 1);
  CHECK(table.rows(0, 9) == std::vector<std::vector<double>>{{1}, {7}});
  write_file(path, "x\n");
  table.update();
  CHECK(table.generation() == 2);
  CHECK(table.rows() == 0);
  std::filesystem::remove(path);
  table.update();
  CHECK(table.generation() == 3);
  CHECK(table.columns().empty());
}
