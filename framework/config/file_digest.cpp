#include "framework/config/file_digest.hpp"

#include <fmt/format.h>

#include <fstream>
#include <vector>

#include "geometry/checksum.hpp"

namespace tack {
namespace {

constexpr std::size_t chunk = std::size_t{1} << 20;  // bytes

void add_digests(const Value& value, std::map<std::string, std::string>& digests) {
  if (value.is_scalar() && value.text.starts_with('/') && !digests.contains(value.text))
    if (std::string digest = file_digest(value.text); !digest.empty()) digests[value.text] = std::move(digest);
  for (const Value& item : value.items) add_digests(item, digests);
  for (const Value::Entry& entry : value.entries) add_digests(entry.value, digests);
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

std::map<std::string, std::string> file_digests(const Value& scene) {
  std::map<std::string, std::string> digests;
  for (const Value::Entry& entry : scene.entries)
    if (entry.key != "start") add_digests(entry.value, digests);
  return digests;
}

}  // namespace tack
