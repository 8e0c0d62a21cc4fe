#include "geometry/checksum.hpp"

#include <zlib.h>

namespace tack {

std::uint32_t crc32_of(const void* bytes, std::size_t size, std::uint32_t before) {
  if (size == 0) return before;
  return static_cast<std::uint32_t>(::crc32_z(before, static_cast<const Bytef*>(bytes), size));
}

}  // namespace tack
