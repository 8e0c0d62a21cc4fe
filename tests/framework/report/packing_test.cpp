#include "framework/report/packing.hpp"

#include <zlib.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>

using namespace tack;

namespace {

std::string inflated(const std::string& packed, size_t size) {
  std::string out(size, '\0');
  uLongf length = size;
  REQUIRE(uncompress(reinterpret_cast<Bytef*>(out.data()), &length, reinterpret_cast<const Bytef*>(packed.data()), packed.size()) == Z_OK);
  REQUIRE(length == size);
  return out;
}

// Packing as report/src/unpack.js reads it.
std::vector<std::vector<std::uint16_t>> frames_of(const std::string& bytes, size_t frames) {
  const size_t n = bytes.size() / 2 / frames;
  std::vector<std::vector<std::uint16_t>> out(frames, std::vector<std::uint16_t>(n));
  for (size_t f = 0; f < frames; ++f)
    for (size_t i = 0; i < n; ++i) {
      const auto low = static_cast<unsigned char>(bytes[2 * n * f + i]), high = static_cast<unsigned char>(bytes[2 * n * f + n + i]);
      const int code = low | high << 8, difference = (code >> 1) ^ -(code & 1);
      const int before = f > 0 ? out[f - 1][i] : i > 0 ? out[f][i - 1] : 0;
      out[f][i] = static_cast<std::uint16_t>(before + difference);
    }
  return out;
}

}  // namespace

TEST_CASE("base64 is that of RFC 4648") {
  CHECK(base64("") == "");
  CHECK(base64("f") == "Zg==");
  CHECK(base64("fo") == "Zm8=");
  CHECK(base64("foo") == "Zm9v");
  CHECK(base64("foobar") == "Zm9vYmFy");
  CHECK(base64(std::string("\xff\x00\xfe\xfb", 4)) == "/wD++w==");
}

TEST_CASE("deflated bytes inflate to the same") {
  std::string bytes;
  for (int i = 0; i < 5000; ++i) bytes += static_cast<char>(i * i);
  CHECK(inflated(deflated(bytes), bytes.size()) == bytes);
  CHECK(inflated(deflated(""), 0) == "");
}

TEST_CASE("planes hold the bytes of numbers, lowest first") {
  const std::vector<float> numbers = {1.0f, -2.5f, 3.25e-7f};
  const std::string bytes = planes(std::span<const float>(numbers));
  REQUIRE(bytes.size() == 12);
  for (size_t i = 0; i < 3; ++i) {
    char own[4];
    for (size_t b = 0; b < 4; ++b) own[b] = bytes[3 * b + i];
    float back;
    std::memcpy(&back, own, 4);
    CHECK(back == numbers[i]);
  }
  const std::vector<double> one = {0.1};
  double back;
  std::memcpy(&back, planes(std::span<const double>(one)).data(), 8);
  CHECK(back == 0.1);
}

TEST_CASE("the error of a quantised number is at most half a step") {
  std::mt19937 random(3);
  for (const int levels : {2, 1023, 65535}) {
    const Quantizer q{-0.3, 1.7, levels};
    const double step = 2.0 / (levels - 1);
    std::uniform_real_distribution<double> any(q.lowest, q.highest);
    for (int i = 0; i < 1000; ++i) {
      const double number = any(random);
      CHECK(std::abs(q.number(q.code(number)) - number) <= 0.5 * step * (1 + 1e-9));
    }
    CHECK(q.code(q.lowest) == 1);
    CHECK(q.code(q.highest) == levels);
    CHECK(q.number(q.code(q.highest)) == Approx(q.highest));
    CHECK(q.code(std::nan("")) == 0);
    CHECK(q.code(std::numeric_limits<double>::infinity()) == 0);
    CHECK(std::isnan(q.number(0)));
  }
  const Quantizer constant{2, 2, 1023};
  CHECK(constant.number(constant.code(2)) == 2);
}

TEST_CASE("frames of codes come back from their differences") {
  std::mt19937 random(5);
  std::uniform_int_distribution<int> any(0, 65535);
  std::vector<std::vector<std::uint16_t>> frames(4, std::vector<std::uint16_t>(37));
  for (auto& frame : frames)
    for (auto& code : frame) code = static_cast<std::uint16_t>(any(random));
  frames[1][0] = 0, frames[2][0] = 65535, frames[3][0] = 0;
  CHECK(frames_of(delta_planes(frames), frames.size()) == frames);
}
