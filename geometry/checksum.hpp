// CRC-32 (zlib's), to notice damage and difference; no protection against intent.
#pragma once

#include <cstddef>
#include <cstdint>

namespace tack {

// Of `size` bytes behind those that gave `before`.
std::uint32_t crc32_of(const void* bytes, std::size_t size, std::uint32_t before = 0);

}  // namespace tack
