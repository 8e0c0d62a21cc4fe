// CRC-32 (zlib's), to notice damage and difference; no protection against intent.
#pragma once

#include <cstddef>
#include <cstdint>

namespace tack {

// Returns the checksum of `size` bytes that follow those with the checksum `before`.
std::uint32_t crc32_of(const void* bytes, std::size_t size, std::uint32_t before = 0);

}  // namespace tack
