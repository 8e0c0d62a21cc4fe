// The figure of docs/tutorial.md meets the requirements of journals (docs/plotting.md), measured in
// its PDF.
#include <algorithm>
#include <catch2/catch.hpp>

#include "tests/support/pdf.hpp"
#include "tests/support/program.hpp"

using namespace tack;
namespace fs = std::filesystem;

namespace {

constexpr double millimetre = 72 / 25.4;  // pt
const fs::path tutorial = fs::path(TACK_SOURCE_DIR) / "experiments/tutorial";

}  // namespace

TEST_CASE("the tutorial's figure meets the requirements of journals", "[plot]") {
  const TemporaryFolder folder;
  // A few steps with larger cells: the figure's names and ranges, not its numbers.
  const ProgramResult batch = run_tack(folder.path(), {"batch", (tutorial / "stamps.yaml").string(), "-q", "-o", "stamps", "--set",
                                                       "set=['expect=[]', output.frames=false, time.duration=50 ms, 'objects.stamp.shape.cells=[8, 2, 1]']"});
  INFO(batch.out << batch.err);
  REQUIRE(batch.exit_code == 0);
  const double columns = GENERATE(85, 170);
  const ProgramResult plot = run_tack(folder.path(), {"plot", "stamps", "--x", "young", "--y", "pull_off", "--by", "strength", "--log-x", "-o", "figure", "--style",
                                                      (tutorial / "column.yaml").string(), "--set", "width=" + std::to_string(columns) + "mm"});
  if (contains(plot.out + plot.err, "gnuplot is missing")) return;
  INFO(plot.out << plot.err);
  REQUIRE(plot.exit_code == 0);
  const PdfPage page = read_pdf(folder.path() / "figure/pull_off_by_young.pdf");
  CHECK(page.width == Approx(columns * millimetre).margin(0.5 * millimetre));
  CHECK(page.height == Approx(page.width * 2 / 3).margin(1));
  REQUIRE(page.text_sizes.size() > 10);
  CHECK(*std::min_element(page.text_sizes.begin(), page.text_sizes.end()) >= 7);
  CHECK(*std::max_element(page.text_sizes.begin(), page.text_sizes.end()) == Approx(8).epsilon(0.01));
  REQUIRE(page.line_widths.size() > 10);
  CHECK(*std::min_element(page.line_widths.begin(), page.line_widths.end()) >= 0.5);
  CHECK(*std::max_element(page.line_widths.begin(), page.line_widths.end()) == Approx(1).epsilon(0.01));  // line_width: 1
  CHECK(page.images == 0);
  CHECK(page.fonts > 0);
  CHECK(page.embedded_fonts == page.fonts);
  CHECK(page.type3_fonts == 0);
  for (const char* text : {"Young's modulus [Pa]", "[kPa]", "strength 10 kPa"}) CHECK(contains(page.readable, text));
}
