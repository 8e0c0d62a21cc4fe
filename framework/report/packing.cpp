#include "framework/report/packing.hpp"

#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>

namespace tack {
namespace {

static_assert(std::endian::native == std::endian::little, "planes begin with the lowest byte");

template <class Number>
std::string planes_of(std::span<const Number> numbers) {
  const size_t n = numbers.size();
  std::string bytes(n * sizeof(Number), '\0');
  for (size_t i = 0; i < n; ++i) {
    char own[sizeof(Number)];
    std::memcpy(own, &numbers[i], sizeof own);
    for (size_t b = 0; b < sizeof own; ++b) bytes[b * n + i] = own[b];
  }
  return bytes;
}

// Differences are modulo 2^16; the page adds modulo 2^16.
std::uint16_t zigzag(std::uint16_t from, std::uint16_t to) {
  const auto difference = static_cast<std::int16_t>(static_cast<std::uint16_t>(to - from));
  return static_cast<std::uint16_t>((static_cast<std::uint16_t>(difference) << 1) ^ (difference < 0 ? 0xffff : 0));
}

}  // namespace

std::string deflated(std::string_view bytes) {
  uLongf size = compressBound(bytes.size());
  std::string out(size, '\0');
  const int status = compress2(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size(), 7);
  if (status != Z_OK) throw std::runtime_error("zlib: not enough memory");
  out.resize(size);
  return out;
}

std::string base64(std::string_view bytes) {
  static constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (size_t i = 0; i < bytes.size(); i += 3) {
    const size_t n = std::min<size_t>(3, bytes.size() - i);
    std::uint32_t word = 0;
    for (size_t b = 0; b < 3; ++b) word = word << 8 | (b < n ? static_cast<unsigned char>(bytes[i + b]) : 0);
    for (size_t d = 0; d < 4; ++d) out += d <= n ? digits[word >> (18 - 6 * d) & 63] : '=';
  }
  return out;
}

std::string planes(std::span<const double> numbers) { return planes_of(numbers); }
std::string planes(std::span<const float> numbers) { return planes_of(numbers); }

std::uint16_t Quantizer::code(double number) const {
  if (!std::isfinite(number)) return 0;
  const double fraction = highest > lowest ? (number - lowest) / (highest - lowest) : 0;
  return static_cast<std::uint16_t>(1 + std::lround(std::clamp(fraction, 0.0, 1.0) * (levels - 1)));
}

double Quantizer::number(std::uint16_t code) const {
  if (code == 0) return std::numeric_limits<double>::quiet_NaN();
  return lowest + (highest - lowest) * (code - 1) / (levels - 1);
}

std::string delta_planes(const std::vector<std::vector<std::uint16_t>>& frames) {
  std::string bytes;
  for (size_t f = 0; f < frames.size(); ++f) {
    const auto& now = frames[f];
    const size_t n = now.size(), start = bytes.size();
    bytes.resize(start + 2 * n);
    for (size_t i = 0; i < n; ++i) {
      const std::uint16_t before = f > 0 ? frames[f - 1][i] : i > 0 ? now[i - 1] : 0;
      const std::uint16_t code = zigzag(before, now[i]);
      bytes[start + i] = static_cast<char>(code & 0xff);
      bytes[start + n + i] = static_cast<char>(code >> 8);
    }
  }
  return bytes;
}

}  // namespace tack
