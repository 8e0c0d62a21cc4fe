// Names from a file are plain text to gnuplot, whatever their characters.
#include "framework/plot/gnuplot.hpp"

#include <catch2/catch.hpp>
#include <cstdio>
#include <cstdlib>

#include "tests/support/program.hpp"

using namespace tack;
namespace fs = std::filesystem;

namespace {

// Each name would create the file "owned" if gnuplot executed it.
const std::vector<std::string> hostile = {
    "x\nsystem(\"touch owned\")\n#",   "x'\nsystem 'touch owned'\n'", "x\r\n!touch owned\r\n",
    "x', 1 title system('touch owned') #", "`touch owned`",            "@system",
    "x\\\nsystem 'touch owned'",      "\"; system 'touch owned'; \"", "x' ; set print 'owned' ; print 1 ; #",
    std::string("x\0\nsystem 'touch owned'\n", 25), "{/Symbol a}_b^c @d & <tag> %s", "\\", "'upper' - 'lower'", "'"};

}  // namespace

TEST_CASE("no name reaches gnuplot as a command or markup", "[plot]") {
  const TemporaryFolder folder;
  for (const std::string& name : hostile) {
    INFO(name);
    Plot plot;
    plot.title = plot.x_label = plot.y_label = name;
    plot.log_x = plot.log_y = true;
    plot.levels = {{2.5, name}};
    plot.notes = {name};
    plot.curves.push_back({name, {{1, 2}, {2, 3}}, {}});
    plot.curves.push_back({"b" + name, {{1, 3}, {2, 4}}, {}});
    const std::string failure = draw(plot, folder.path(), "plot");
    CHECK_FALSE(fs::exists(folder.path() / "owned"));
    const std::string script = file_text(folder.path() / "plot.gp");
    CHECK_FALSE(contains(script, "\nsystem"));
    CHECK_FALSE(contains(script, "\n!"));
    if (contains(failure, "gnuplot is missing")) continue;
    CHECK(failure == "");
    CHECK(contains(file_text(folder.path() / "plot.svg"), "</svg>"));
    fs::remove(folder.path() / "plot.svg");
    CHECK(draw(StackedBars{name, name, {name, "b" + name}, {name, "p" + name}, {{1, 2}, {3, 4}}, {}, ""}, folder.path(), "bars") == "");
    CHECK_FALSE(fs::exists(folder.path() / "owned"));
    CHECK(contains(file_text(folder.path() / "bars.svg"), "</svg>"));
  }
}

TEST_CASE("every renderer reads the pictures without clipping", "[plot]") {
  const TemporaryFolder folder;
  const Plot plot{.title = "t", .x_label = "x", .y_label = "y", .curves = {{"a", {{1, 2}, {2, 3}}, {{1, 3}, {2, 4}}}}, .levels = {}, .notes = {}};
  const std::string failure = draw(plot, folder.path(), "plot");
  if (contains(failure, "gnuplot is missing")) return;
  CHECK(failure == "");
  CHECK_FALSE(contains(file_text(folder.path() / "plot.svg"), "scale(0.00)"));  // a mark of no size is an error to librsvg

  const std::string name = "young 0.1 MPa, traction 3 kPa, 5 x 5 cells, and then some more of it";
  CHECK(draw(StackedBars{"t", "y", {name, "b"}, {"p"}, {{1}, {2}}, {}, ""}, folder.path(), "bars") == "");
  const std::string svg = file_text(folder.path() / "bars.svg");
  const size_t at = svg.find(") rotate(-35");
  REQUIRE(at != std::string::npos);
  double x = 0, y = 0;
  const size_t from = svg.rfind("translate(", at);
  REQUIRE(std::sscanf(svg.c_str() + from, "translate(%lf,%lf)", &x, &y) == 2);
  const double length = 34 * 7;  // px, of a name at 13 px
  CHECK(x > length * 0.82);
  CHECK(y + length * 0.58 < 480);
}

TEST_CASE("long names of curves are cut between characters", "[plot]") {
  const TemporaryFolder folder;
  const std::string begin(30, 'x');  // the cut would be within the letter behind it
  const Plot plot{.title = "t", .x_label = "x", .y_label = "y", .curves = {{begin + "\u00e4hnlich", {{1, 2}, {2, 3}}, {}}, {"b", {{1, 3}, {2, 4}}, {}}}, .levels = {}, .notes = {}};
  const std::string failure = draw(plot, folder.path(), "plot");
  CHECK(contains(file_text(folder.path() / "plot.gp"), begin + "..."));
  CHECK((failure.empty() || contains(failure, "gnuplot is missing")));
}

TEST_CASE("a style sets the size of pictures for paper", "[plot]") {
  const TemporaryFolder folder;
  const Plot plot{.title = "of runs", .x_label = "gap", .y_label = "force", .x_unit = "m", .y_unit = "N",
                  .curves = {{"a", {{1e-3, 2}, {2e-3, 3}}, {}}, {"b", {{1e-3, 3}, {2e-3, 4}}, {}}}, .levels = {}, .notes = {}};
  FigureStyle look;
  look.width = 0.0889;  // 3.5 inches
  look.font_size = 8;
  look.line_width = 1.5;
  look.untitled = look.pdf = true;
  look.x_label = "opening";
  look.colours = {"#112233"};
  const std::string failure = draw(plot, folder.path(), "plot", look);
  if (contains(failure, "gnuplot is missing")) return;
  CHECK(failure == "");
  const std::string svg = file_text(folder.path() / "plot.svg");
  CHECK(contains(svg, "width=\"336\" height=\"224\""));
  CHECK(contains(svg, "opening [mm]"));
  CHECK(contains(svg, "force [N]"));
  CHECK_FALSE(contains(svg, "of runs"));
  CHECK(contains(svg, "rgb( 17,  34,  51)"));
  const char* const usual_colour = "rgb(  0, 114, 178)";  // of the first curve
  CHECK_FALSE(contains(svg, usual_colour));
  CHECK(draw(plot, folder.path(), "usual") == "");
  const std::string usual = file_text(folder.path() / "usual.svg");
  CHECK(contains(usual, usual_colour));
  CHECK(contains(usual, "of runs"));
  CHECK(contains(svg, "font-size=\"10.67\""));      // 8 points
  CHECK(file_text(folder.path() / "plot.pdf").starts_with("%PDF"));
  const std::string png = file_text(folder.path() / "plot.png");  // 600 dots an inch: width and height stand in bytes 16 to 23
  REQUIRE(png.size() > 24);
  const auto number = [&](size_t at) { return (static_cast<unsigned char>(png[at + 2]) << 8) + static_cast<unsigned char>(png[at + 3]); };
  CHECK(number(16) == 2100);
  CHECK(number(20) == 1400);
  CHECK(draw(StackedBars{"t", "y", {"one", "two"}, {"p"}, {{1}, {2}}, {}, ""}, folder.path(), "bars", look) == "");
  CHECK(contains(file_text(folder.path() / "bars.svg"), "width=\"336\" height=\"224\""));
}

TEST_CASE("a mark across a bar is drawn in the unit of the axis, and fits below its end", "[plot]") {
  const TemporaryFolder folder;
  StackedBars bars{"t", "force", {"one", "two"}, {"here"}, {{1000}, {2000}}, {}, "N"};
  bars.marks = {{1, 5000, "5 kN, Them"}};
  draw(bars, folder.path(), "bars");
  const std::string script = file_text(folder.path() / "bars.gp");
  CHECK(contains(script, "set arrow from 0.55,5 to 1.45,5"));
  CHECK(contains(script, "set label '5 kN, Them' at 1,5"));
  CHECK(contains(script, "unset key"));
  double top = 0;
  REQUIRE(std::sscanf(script.c_str() + script.find("set yrange [0:"), "set yrange [0:%lf]", &top) == 1);
  CHECK(top > 5);
}

TEST_CASE("titles of bands stand above the curves", "[plot]") {
  const TemporaryFolder folder;
  const auto upper_end = [&](bool log, const std::vector<Band>& bands) {
    Plot plot;
    plot.log_y = log;
    plot.curves.push_back({"force", {{0, 1}, {10, 2}}, {}});
    plot.bands = bands;
    draw(plot, folder.path(), "plot");
    const std::string script = file_text(folder.path() / "plot.gp");
    const size_t range = script.find("set yrange [");
    double low = 0, high = 0;
    REQUIRE(std::sscanf(script.c_str() + range, "set yrange [%lf:%lf]", &low, &high) == 2);
    return AxisRange{low, high, log}.position(2);
  };
  for (const bool log : {false, true}) {
    const double bare = upper_end(log, {});
    const double across = upper_end(log, {{0, 5, "approach"}, {5, 10, "dwell"}});
    const double upright = upper_end(log, {{0, 9.2, "approach"}, {9.2, 9.8, "retraction"}});
    CHECK(bare == Approx(1 - 1 / 22.0).epsilon(1e-3));
    CHECK(across == Approx(bare * (1 - 20 / 384.0)).epsilon(1e-4));              // a row of 20 pixels
    CHECK(upright == Approx(bare * (1 - 10 * 0.6 * 13 / 384)).epsilon(1e-4));  // ten letters upright
    CHECK(upper_end(log, {{0, 10, "all of it"}, {11, 12, "beyond the axis, and its title is long"}}) == Approx(across));
  }
}
