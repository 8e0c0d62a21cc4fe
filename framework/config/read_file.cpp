#include "framework/config/read_file.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>

#include "geometry/errors.hpp"

namespace tack {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& path, const std::string& why) {
  throw InputError(fmt::format("{}: cannot read this file: {}", path.string(), why));
}

}  // namespace

std::string read_file(const fs::path& path, std::uintmax_t largest) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) refuse(path, "there is none; check the path");
  if (fs::is_directory(status)) refuse(path, "it is a folder; give a file");
  if (!fs::is_regular_file(status)) refuse(path, "it is a device or a pipe; store what it gives in a file");
  const std::uintmax_t size = fs::file_size(path, error);
  if (!error && size > largest)
    refuse(path, fmt::format("it has {} bytes, and {} is the most; is it the right one?", size, largest));
  errno = 0;
  std::ifstream in(path, std::ios::binary);
  std::string text(error ? 0 : size, '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (error || !in) refuse(path, errno ? std::strerror(errno) : "it shrank while it was read; try again");
  return text;
}

}  // namespace tack
