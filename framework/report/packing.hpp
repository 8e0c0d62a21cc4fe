// Numbers as text that a page carries: bytes ordered so that they compress well, deflated (zlib), in base64.
// report/src/unpack.js is the other side.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tack {

// deflated() throws std::runtime_error if there is not enough memory.
std::string deflated(std::string_view bytes);
std::string base64(std::string_view bytes);

// The first bytes of all numbers, then the second ones, ...
std::string planes(std::span<const double> numbers);
std::string planes(std::span<const float> numbers);

// A number as one of `levels` steps from `lowest` to `highest`, off by half a step at most; 0 for what is not finite.
struct Quantizer {
  double lowest = 0, highest = 0;
  int levels = 0;  // codes are 1 to levels; at most 65535

  std::uint16_t code(double number) const;
  double number(std::uint16_t code) const;  // NaN for 0
};

// Frames of as many codes each: the first as differences from code to code, all others from frame to frame, both zigzag
// (0, -1, 1, -2, ...) in two planes of bytes.
std::string delta_planes(const std::vector<std::vector<std::uint16_t>>& frames);

}  // namespace tack
