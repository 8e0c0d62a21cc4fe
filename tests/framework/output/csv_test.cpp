#include "framework/output/csv.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "geometry/errors.hpp"
#include "tests/support/silence.hpp"

using namespace tack;

namespace {

std::string text_of(const std::filesystem::path& path) {
  std::ifstream in(path);
  return {std::istreambuf_iterator<char>(in), {}};
}

constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace

TEST_CASE("a csv file is complete after each row") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "t.csv";
  CsvFile file(path, {{"time", "a \"b\", c"}, {{0, 1}}});
  CHECK(text_of(path) == "time,\"a \"\"b\"\", c\"\n0,1\n");
  file.add(std::vector<double>{0.1, 12345678});
  CHECK(text_of(path) == "time,\"a \"\"b\"\", c\"\n0,1\n0.1,12345678\n");
}

TEST_CASE("csv numbers read back as the same bits") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "t.csv";
  const std::vector<double> row = {0.1 + 0.2, 1.0 / 3.0, 5e-324,       -1.7976931348623157e308,
                                   infinity,  -infinity, std::nan(""), 1e16};
  CsvFile file(path, {{"a", "b", "c", "d", "e", "f", "g", "h,\""}, {}});
  file.add(row);
  const CsvTable table = read_csv(path);
  CHECK(table.columns.back() == "h,\"");
  REQUIRE(table.rows.size() == 1);
  for (std::size_t i = 0; i < row.size(); ++i) {
    if (i == 6) {
      CHECK(std::isnan(table.rows[0][i]));
    } else {
      CHECK(table.rows[0][i] == row[i]);
    }
  }
  CHECK(table.column("c") == std::size_t(2));
  CHECK_FALSE(table.column("none"));
}

TEST_CASE("an interrupted last line is skipped, and a malformed line is an error") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "t.csv";
  std::ofstream(path) << "time,a\r\n0,1\r\n1,2\n2,";
  const CsvTable table = read_csv(path);
  REQUIRE(table.rows.size() == 2);
  CHECK(rows_until(table, 0.5, "t.csv").rows == std::vector<std::vector<double>>{{0, 1}});
  CHECK(rows_until(table, 1, "t.csv").rows.size() == 2);
  std::ofstream(path) << "time,a\n0,1\n1\n";
  CHECK_THROWS_WITH(read_csv(path), Catch::StartsWith(path.string() + ":3: 1 cells"));
  std::ofstream(path) << "time,a\n0,x\n";
  CHECK_THROWS_WITH(read_csv(path), Catch::StartsWith(path.string() + ":2: 'x' is not a number"));
  std::ofstream(path) << "";
  CHECK_THROWS_AS(read_csv(path), InputError);
  CHECK_THROWS_AS(read_csv(folder.path() / "none.csv"), InputError);
  CHECK_THROWS_WITH(rows_until({{"a"}, {}}, 1, "t.csv"), Catch::StartsWith("t.csv: "));
}

TEST_CASE("errors of csv files name the cause") {
  const TemporaryFolder folder;
  const auto nowhere = folder.path() / "none" / "t.csv";
  CHECK_THROWS_WITH(CsvFile(nowhere, {{"a"}, {}}),
                    Catch::StartsWith(nowhere.string() + ": cannot be written"));
  CHECK_THROWS_WITH(CsvFile(folder.path() / "t.csv", {{"b", "a", "b"}, {}}),
                    Catch::Contains("two columns are named 'b'"));
  CsvFile file(folder.path() / "t.csv", {{"a", "b"}, {}});
  CHECK_THROWS_AS(file.add(std::vector<double>{1}), std::logic_error);
}

TEST_CASE("a csv file of texts is read without its quotes") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "t.csv";
  std::ofstream(path) << "case,\"a, b\"\n\"x \"\"y\"\"\",\n1,2.5\n";
  const CsvTexts table = read_csv_texts(path);
  CHECK(table.columns == std::vector<std::string>{"case", "a, b"});
  CHECK(table.rows == std::vector<std::vector<std::string>>{{"x \"y\"", ""}, {"1", "2.5"}});
  std::ofstream(path) << "case,b\nx\n";
  CHECK_THROWS_AS(read_csv_texts(path), InputError);
  CHECK(csv_number("2.5e-3") == 2.5e-3);
  CHECK_FALSE(csv_number(""));
  CHECK_FALSE(csv_number("2.5 m"));
}

TEST_CASE("texts like formulas are escaped in the file and read back unchanged") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "t.csv";
  const std::vector<std::string> texts = {"=cmd|'/C calc'!A0", "+1 kg", "-x, or y", "@sum", "'=1", "''-2", "'plain", "-5", "-1e-3", "a=b", "", "'",
                                          "two\nlines", "\"=quoted\""};
  std::string text = "case\n";
  for (const std::string& one : texts) text += csv_cell(one) + "\n";
  std::ofstream(path) << text;
  CHECK(csv_cell("=1") == "'=1");
  CHECK(csv_cell("-5") == "-5");
  const CsvTexts table = read_csv_texts(path);
  REQUIRE(table.rows.size() == texts.size());
  for (size_t i = 0; i < texts.size(); ++i) CHECK(table.rows[i] == std::vector<std::string>{texts[i]});
  // No cell of the file is a formula.
  for (const std::string& one : texts) CHECK((csv_number(one) || std::string("=+-@").find(csv_cell(one)[0]) == std::string::npos || one.empty()));
}

TEST_CASE("a truncated cell of several lines ends the table") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "t.csv";
  std::ofstream(path) << "a,b\n1,\"x\ny\"\n2,\"cut\n";
  CHECK(read_csv_texts(path).rows == std::vector<std::vector<std::string>>{{"1", "x\ny"}});
  std::ofstream(path) << "a,b\n1,\"x\ny\"\n2\n";
  CHECK_THROWS_WITH(read_csv_texts(path), Catch::Contains("t.csv:4: 1 cells"));
}
