#include "framework/output/file_names.hpp"

#include <catch2/catch.hpp>

using namespace tack;

TEST_CASE("texts that differ have file names that differ", "[output]") {
  CHECK(file_name("a b/c:d-e_f.g") == "a_b_c_d-e_f.g");
  CHECK(file_name("\u03c3 \u00fc") == "\u03c3_\u00fc");
  FileNames names;
  CHECK(names.of("a_b") == "a_b");
  CHECK(names.of("a b") == "a_b.2");
  CHECK(names.of("a/b") == "a_b.3");
  CHECK(names.of("a b") == "a_b.2");
  CHECK(names.of("a_b.2") == "a_b.2.2");
}
