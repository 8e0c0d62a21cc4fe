#include "geometry/utf8_prefix.hpp"

#include <catch2/catch.hpp>

using namespace tack;

TEST_CASE("the beginning of a text ends between characters", "[geometry]") {
  const std::string_view text = "a\xC3\xA4\xE2\x82\xAC\xF0\x9F\x98\x80z";  // characters of 1, 2, 3, 4 and 1 bytes
  const std::size_t ends[] = {0, 1, 1, 3, 3, 3, 6, 6, 6, 6, 10, 11};
  for (std::size_t bytes = 0; bytes < std::size(ends); ++bytes) {
    CAPTURE(bytes);
    CHECK(utf8_prefix(text, bytes) == text.substr(0, ends[bytes]));
  }
  CHECK(utf8_prefix(text, 100) == text);
  CHECK(utf8_prefix("", 0).empty());
  CHECK(utf8_prefix("\x80\x80\x80", 2).empty());  // no UTF-8
}
