#include "framework/config/file_digest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "geometry/checksum.hpp"

namespace tack {
namespace {

constexpr std::size_t chunk = std::size_t{1} << 20;  // bytes

void add_paths(const Value& value, std::vector<std::string>& paths) {
  if (value.is_scalar() && value.text.starts_with('/') && std::find(paths.begin(), paths.end(), value.text) == paths.end()) paths.push_back(value.text);
  for (const Value& item : value.items) add_paths(item, paths);
  for (const Value::Entry& entry : value.entries) add_paths(entry.value, paths);
}

}  // namespace

std::string file_digest(const std::filesystem::path& path) {
  std::error_code none;
  if (!std::filesystem::is_regular_file(path, none)) return "";
  std::ifstream in(path, std::ios::binary);
  std::vector<char> bytes(chunk);
  std::uint32_t checksum = 0;
  std::uintmax_t size = 0;
  while (in) {
    in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    const auto got = static_cast<std::size_t>(in.gcount());
    checksum = crc32_of(bytes.data(), got, checksum);
    size += got;
  }
  return in.eof() ? fmt::format("{}-{:08x}", size, checksum) : "";
}

std::vector<std::string> named_paths(const Value& value) {
  std::vector<std::string> paths;
  add_paths(value, paths);
  return paths;
}

std::map<std::string, std::string> file_digests(const Value& scene) {
  std::map<std::string, std::string> digests;
  for (const Value::Entry& entry : scene.entries)
    if (entry.key != "start")
      for (const std::string& path : named_paths(entry.value))
        if (std::string digest = digests.contains(path) ? "" : file_digest(path); !digest.empty()) digests[path] = std::move(digest);
  return digests;
}

}  // namespace tack
