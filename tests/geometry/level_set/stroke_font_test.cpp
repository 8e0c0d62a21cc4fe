// Letters as lines: their height, their centre, and the symmetries of capitals.
#include "geometry/level_set/stroke_font.hpp"

#include <catch2/catch.hpp>
#include <algorithm>
#include <set>

#include "geometry/errors.hpp"

using namespace tack;

namespace {

// Strokes as sets of their ends, reflected along x, y or both.
std::set<std::set<std::pair<int, int>>> reflected(std::string_view text, double x, double y) {
  std::set<std::set<std::pair<int, int>>> strokes;
  for (const Stroke& s : text_strokes(text)) {
    std::set<std::pair<int, int>> ends;
    for (const Vec2& p : s) ends.insert({static_cast<int>(std::lround(12 * x * p.x())), static_cast<int>(std::lround(12 * y * p.y()))});
    strokes.insert(ends);
  }
  return strokes;
}

}  // namespace

TEST_CASE("every letter is within its line, which is one unit high, and capitals and digits fill the height", "[level_set][font]") {
  for (const char c : std::string("ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789.,!?-+=/:'&")) {
    const auto strokes = text_strokes(std::string(1, c));
    INFO(c);
    REQUIRE_FALSE(strokes.empty());
    double low = 1, high = -1;
    for (const Stroke& s : strokes) {
      CHECK((s[1] - s[0]).norm() > 0);
      for (const Vec2& p : s) low = std::min(low, p.y()), high = std::max(high, p.y());
    }
    CHECK(low >= -0.5);
    CHECK(high <= 0.5);
    if (!std::isalnum(static_cast<unsigned char>(c))) continue;
    CHECK(low == Approx(-0.5));
    CHECK(high == Approx(0.5));
  }
}

TEST_CASE("capitals have their symmetries about the centre of the line", "[level_set][font]") {
  // A is left out: its bar is not in the middle.
  for (const char* c : {"H", "I", "M", "O", "T", "U", "V", "X", "Y"}) CHECK(reflected(c, -1, 1) == reflected(c, 1, 1));
  for (const char* c : {"C", "D", "H", "I", "O", "X"}) CHECK(reflected(c, 1, -1) == reflected(c, 1, 1));
  for (const char* c : {"H", "I", "N", "O", "X", "Z"}) CHECK(reflected(c, -1, -1) == reflected(c, 1, 1));
  CHECK(reflected("L", -1, 1) != reflected("L", 1, 1));
}

TEST_CASE("a mirrored word is the reversed word of mirrored letters", "[level_set][font]") {
  CHECK(reflected("TOX", -1, 1) == reflected("XOT", 1, 1));
  CHECK(reflected("OTTO", -1, 1) == reflected("OTTO", 1, 1));
}

TEST_CASE("small letters are capitals, blanks have a width and no strokes, and other characters are refused", "[level_set][font]") {
  CHECK(text_strokes("Tack 2").size() == text_strokes("TACK 2").size());
  CHECK(reflected("tack", 1, 1) == reflected("TACK", 1, 1));
  CHECK(text_strokes("").empty());
  CHECK(text_strokes("  ").empty());
  CHECK(text_strokes("A B").size() == text_strokes("AB").size());
  CHECK(reflected("A B", 1, 1) != reflected("AB", 1, 1));
  CHECK_THROWS_WITH(text_strokes("A#"), Catch::Contains("'#'"));
}
