#include "geometry/io/replace_file.hpp"

#include <sys/stat.h>

#include <catch2/catch.hpp>

#include "geometry/errors.hpp"
#include "tests/support/silence.hpp"

using namespace tack;

namespace {

std::string text_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

TEST_CASE("a file is replaced as a whole and leaves nothing beside it") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "a.txt";
  replace_file(path, "first, and longer");
  replace_file(path, std::string_view("b\0c", 3));
  CHECK(text_of(path) == std::string("b\0c", 3));
  CHECK_FALSE(std::filesystem::exists(folder.path() / "a.txt.part"));
}

TEST_CASE("a pipe is written to and not replaced") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "pipe";
  REQUIRE(::mkfifo(path.c_str(), 0600) == 0);
  const int reader = ::open(path.c_str(), O_RDONLY | O_NONBLOCK);
  replace_file(path, "content");
  char text[16] = {};
  CHECK(::read(reader, text, sizeof text) == 7);
  CHECK(std::string(text) == "content");
  ::close(reader);
  CHECK(std::filesystem::is_fifo(path));
  CHECK_FALSE(std::filesystem::exists(folder.path() / "pipe.part"));
}

TEST_CASE("a file that cannot be replaced is named, and the old one stays") {
  const TemporaryFolder folder;
  const auto missing = folder.path() / "none" / "a.txt";
  CHECK_THROWS_WITH(
      replace_file(missing, "x"),
      Catch::StartsWith(missing.string() + ": cannot be written (No such file or directory)"));
  const auto occupied = folder.path() / "occupied";
  std::filesystem::create_directories(occupied / "inside");
  CHECK_THROWS_AS(replace_file(occupied, "x"), InputError);
  CHECK(std::filesystem::is_directory(occupied / "inside"));
  CHECK_FALSE(std::filesystem::exists(folder.path() / "occupied.part"));
}

TEST_CASE("a full disk is an error and leaves the old file") {
  if (!std::filesystem::exists("/dev/full")) return;
  const TemporaryFolder folder;
  const auto path = folder.path() / "a.txt";
  replace_file(path, "old");
  std::filesystem::create_symlink("/dev/full", folder.path() / "a.txt.part");
  REQUIRE_THROWS_WITH(replace_file(path, "new"), Catch::Contains("No space left on device"));
  CHECK(text_of(path) == "old");
}
