// Names from a file are text to gnuplot, whatever they hold.
#include "framework/plot/gnuplot.hpp"

#include <catch2/catch.hpp>
#include <cstdlib>

#include "tests/support/program.hpp"

using namespace tack;
namespace fs = std::filesystem;

namespace {

// Each would make the file "owned" if gnuplot took it for a command.
const std::vector<std::string> hostile = {
    "x\nsystem(\"touch owned\")\n#",   "x'\nsystem 'touch owned'\n'", "x\r\n!touch owned\r\n",
    "x', 1 title system('touch owned') #", "`touch owned`",            "@system",
    "x\\\nsystem 'touch owned'",      "\"; system 'touch owned'; \"", "x' ; set print 'owned' ; print 1 ; #",
    std::string("x\0\nsystem 'touch owned'\n", 25), "{/Symbol a}_b^c @d & <tag> %s", "\\"};

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
    plot.curves.push_back({name, {{1, 2}, {2, 3}}});
    plot.curves.push_back({"b" + name, {{1, 3}, {2, 4}}});
    const std::string failure = draw(plot, folder.path(), "plot");
    CHECK_FALSE(fs::exists(folder.path() / "owned"));
    const std::string script = file_text(folder.path() / "plot.gp");
    CHECK_FALSE(contains(script, "\nsystem"));
    CHECK_FALSE(contains(script, "\n!"));
    if (contains(failure, "gnuplot is not there")) continue;
    CHECK(failure == "");
    CHECK(contains(file_text(folder.path() / "plot.svg"), "</svg>"));
    fs::remove(folder.path() / "plot.svg");
    CHECK(draw(StackedBars{name, name, {name, "b" + name}, {name, "p" + name}, {{1, 2}, {3, 4}}, {}}, folder.path(), "bars") == "");
    CHECK_FALSE(fs::exists(folder.path() / "owned"));
    CHECK(contains(file_text(folder.path() / "bars.svg"), "</svg>"));
  }
}
