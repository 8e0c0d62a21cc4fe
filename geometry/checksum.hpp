// CRC-32 (zlib), which detects damage and differences, but not tampering.
#pragma once

#include <cstddef>
#include <cstdint>

namespace tack {

// Returns the checksum of `size` bytes appended to bytes with the checksum `before`.
std::uint32_t crc32_of(const void* bytes, std::size_t size, std::uint32_t before = 0);

}  // namespace tack
