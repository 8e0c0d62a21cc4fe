// Packs numbers into text for a page: bytes ordered for compression, deflated (zlib), in base64.
// report/src/unpack.js unpacks them.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tack {

// deflated() throws std::runtime_error if memory is short.
std::string deflated(std::string_view bytes);
std::string base64(std::string_view bytes);

// Returns the first bytes of all numbers, then the second bytes, ...
std::string planes(std::span<const double> numbers);
std::string planes(std::span<const float> numbers);

// Codes numbers as `levels` steps from `lowest` to `highest`, with an error of half a step; code 0
// stands for numbers that are not finite.
struct Quantizer {
  double lowest = 0, highest = 0;
  int levels = 0;  // codes are 1 to levels; at most 65535

  std::uint16_t code(double number) const;
  double number(std::uint16_t code) const;  // NaN for 0
};

// Returns frames of equal numbers of codes as differences: within the first frame from code to
// code, then from frame to frame; zigzag coded (0, -1, 1, -2, ...), in two planes of bytes.
std::string delta_planes(const std::vector<std::vector<std::uint16_t>>& frames);

}  // namespace tack
