#include "framework/config/quantity_table.hpp"

#include <catch2/catch.hpp>

#include "tests/framework/config/toy.hpp"
#include "tests/support/program.hpp"

using namespace tack;
using Catch::Contains;
using toy::message_of;

namespace {

const std::vector<QuantityColumn> wanted = {{"gap", units::length, "gap_column"}, {"traction", units::pressure, "traction_column"}};

class Table {
 public:
  explicit Table(const std::string& text) { write_file(path(), text); }
  std::string path() const { return (folder_.path() / "law.csv").string(); }
  QuantityTable read() const { return read_quantities(path(), wanted); }
  std::string error() const { return message_of([&] { read(); }); }

 private:
  TemporaryFolder folder_;
};

void check_rows(const std::string& text) {
  INFO(text);
  const QuantityTable table = Table(text).read();
  REQUIRE(table.rows() == 2);
  CHECK(table.columns[0][0] == Approx(1e-6).epsilon(1e-14));
  CHECK(table.columns[0][1] == Approx(2.5e-6).epsilon(1e-14));
  CHECK(table.columns[1][0] == Approx(3e3).epsilon(1e-14));
  CHECK(table.columns[1][1] == 0);
}

}  // namespace

TEST_CASE("columns with units, however a program has written them", "[config]") {
  check_rows("gap [um],traction [kPa]\n1,3\n2.5,0\n");
  check_rows("gap [um], traction [kPa]\r\n1, 3\r\n2.5, 0\r\n");          // line ends of Windows
  check_rows("gap [um],traction [kPa]\r1,3\r2.5,0\r");                   // and of old Macintoshes
  check_rows("\xef\xbb\xbfgap [um],traction [kPa]\n1,3\n2.5,0\n");        // a byte order mark
  check_rows("gap [um],traction [kPa]\n1,3\n2.5,0");                     // no line end
  check_rows("gap [um],traction [kPa]\n1,3\n2.5,0\n\n\n  \n,\n");        // empty lines
  check_rows("# measured\n\ngap [um],traction [kPa]\n# first\n1,3\n2.5,0\n");
  check_rows("gap (\xc2\xb5m);traction (N/mm^2)\n1;0.003\n2.5;0\n");      // semicolons, a micro sign
  check_rows("gap\ttraction\num\tkPa\n1\t3\n2.5\t0\n");                  // units in a line of their own
  check_rows("gap,traction\n[um],[kPa]\n1,3\n2.5,0\n");
  check_rows("gap,traction\n1e-6,+3e3\n2.5e-6,0\n");                     // SI
  check_rows("time [s],Traction [kPa],GAP [um],note\n0,3,1,a\n1,0,2.5,\"b, c\"\n");  // other columns, another order
  check_rows("\"gap [um]\",\"traction [kPa]\"\n\"1\",\"3\"\n2.5,0,,\n");   // quotes, empty cells behind
}

TEST_CASE("titles above the names, and decimal commas, as testing machines write them", "[config]") {
  check_rows("Specimen label;PSA-7\n\nTest speed;1,5;mm/s\ngap;traction\n(um);(kPa)\n1,0;3\n2,5;0\n");
  check_rows("\"Results Table 1\"\n\"Operator\",\"3\" probe\"\n\ntime,gap,traction\n(s),(um),(kPa)\n\"0\",\"1\",\"3\"\n\"1\",\"2.5\",\"0\"\n");
  check_rows("gap\tof the joint\ngap [um]\ttraction [kPa]\n1,00\t3,0\n2,50\t0,0\n");  // the first line names one of them
  check_rows("gap [um];traction [kPa]\n1,0e0;+3,0\n2,5;-0,0\n");
  check_rows("gap [um],traction [kPa]\n\"1,0\",3\n\"2,5\",0\n");
  check_rows("gap [m];traction [Pa]\n1e-6;3000\n0,0000025;0\n");
  const Table grouped("gap [um];traction [Pa]\n0,5;1,250\n1,5;12,500\n");  // decimal in one column, so in all
  CHECK(grouped.read().columns[1][1] == Approx(12.5));
}

TEST_CASE("commas that may mean two things are refused", "[config]") {
  const auto error = [](const std::string& text) { return Table(text).error(); };
  CHECK_THAT(error("gap [um];traction [Pa]\n1;1,250\n2;12,500\n"),
             Contains("law.csv:2: traction '1,250' may have a decimal comma or a group of thousands; write numbers with a point and without groups"));
  CHECK_THAT(error("gap [um];traction [Pa]\n1.5;3\n2;0,5\n"), Contains("law.csv:3: traction '0,5' has a comma, and other numbers have a point"));
  CHECK_THAT(error("gap [um];traction [Pa]\n1;1.234,5\n"), Contains("law.csv:2: traction '1.234,5' is no number"));
  CHECK_THAT(error("gap [um],traction [kPa]\n1,0,3,0\n"), Contains("law.csv:2: 4 cells, where line 1 names 2; if its commas are decimal ones, separate columns by semicolons"));
  CHECK_THAT(error("Specimen;7\ngap;force\n1;2\n"), Contains("law.csv:2: there is no column 'traction' among 'gap', 'force'"));
  // None of the names is known: the line above the numbers, or above their units, has them.
  CHECK_THAT(error("Specimen;7\n\nway;load\n1;2\n"), Contains("law.csv:3: there is no column 'gap' among 'way', 'load'"));
  CHECK_THAT(error("Specimen;7\nTest speed;1,5;mm/s\nway;load\n(mm);(N)\n0,00;-1,5\n"), Contains("law.csv:3: there is no column 'gap' among 'way', 'load'"));
}

TEST_CASE("rows know their lines", "[config]") {
  const Table table("# a\ngap [um], traction [kPa]\n\n1, 3\n# b\n2, 4\n");
  CHECK(table.read().location(0) == table.path() + ":4: ");
  CHECK(table.read().location(1) == table.path() + ":6: ");
}

TEST_CASE("twenty thousand rows", "[config]") {
  std::string text = "gap [nm], traction [MPa]\r\n";
  for (int i = 0; i < 20000; ++i) text += std::to_string(i) + "," + std::to_string(0.5 * i) + "\r\n";
  const QuantityTable table = Table(text).read();
  REQUIRE(table.rows() == 20000);
  CHECK(table.columns[0].back() == Approx(19999e-9));
  CHECK(table.columns[1].back() == Approx(9999.5e6));
}

TEST_CASE("errors of a table are reported with file and line", "[config]") {
  const auto error = [](const std::string& text) { return Table(text).error(); };
  CHECK_THAT(error(""), Contains("is empty"));
  CHECK_THAT(error("\n\n"), Contains("is empty"));
  CHECK_THAT(error("1,2\n3,4\n"), Contains("law.csv:1: no line above names the columns"));
  CHECK_THAT(error("gab [um],traction [kPa]\n"), Contains("law.csv:1: there is no column 'gap' among 'gab', 'traction'; rename one, or say which one it is by gap_column"));
  CHECK_THAT(error("gap,gap,traction\n"), Contains("two columns are called 'gap'"));
  CHECK_THAT(error("gap [kg],traction [kPa]\n1,2\n"), Contains("law.csv:1: column 'gap': expects a length (m), got '1 kg', which is a mass"));
  CHECK_THAT(error("gap,traction\num,kPx\n1,2\n"), Contains("law.csv:2: column 'traction'") && Contains("'kPx' is no known unit"));
  CHECK_THAT(error("gap [um],traction [kPa]\n1,2\n2,x\n"), Contains("law.csv:3: traction 'x' is no number; mend or remove this line"));
  CHECK_THAT(error("gap [um],traction [kPa]\n1,2\n2,\n"), Contains("law.csv:3: traction '' is empty"));
  CHECK_THAT(error("gap [um],traction [kPa]\n1,2\n2,inf\n"), Contains("law.csv:3: traction 'inf' is not finite"));
  CHECK_THAT(error("gap [um],traction [kPa]\n1,2\n2\n"), Contains("law.csv:3: 1 cells, where line 1 names 2"));
  CHECK_THAT(error("gap [um],traction [kPa]\n1,2,3\n"), Contains("law.csv:2: 3 cells"));
  CHECK_THAT(error("gap [um],\"traction [kPa]\n1,2\n"), Contains("a quote is not closed"));
  CHECK_THAT(error("\xff\xfeg\0a\0"), Contains("UTF-16"));
  CHECK_THAT(message_of([] { read_quantities("/nowhere/law.csv", wanted); }), Contains("/nowhere/law.csv: cannot read this file"));
}
